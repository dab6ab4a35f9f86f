#ifndef {upper}_H
#define {upper}_H {sum}
{head}#if {has_attributes}
#define {all}_FUNCTION static inline __attribute__((unused)){device}
#define {all}_STAGE static inline __attribute__(({inlined})){device}
#else
#define {all}_FUNCTION static inline{device}
#define {all}_STAGE static inline{device}
#endif

{shared}
{own}#ifdef {all}_PRECISE
#pragma float_control(pop)
#undef {all}_PRECISE
#endif
#elif {upper}_H != {sum}
#error "two files have the prefix of this one: give one of them another name"
#endif
