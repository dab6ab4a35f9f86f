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
