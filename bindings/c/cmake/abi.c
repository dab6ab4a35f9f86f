/* The sizes of what programs share with the library: a change of one is another version of the interface. */
#include "piola.h"

#define SIZE(type, size)                                                                                     \
    _Static_assert(sizeof(void *) != 8 || sizeof(type) == (size), #type " has another size")

SIZE(piola_options, 40);
SIZE(piola_survey, 40);
SIZE(piola_parameter, 32);
SIZE(piola_parameter_description, 40);
SIZE(piola_energy_description, 56);
SIZE(piola_part, 16);
SIZE(piola_spring, 96);
SIZE(piola_term, 40);
SIZE(piola_step_report, 104);
