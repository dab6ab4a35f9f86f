#include "energy.h"
#include <stdio.h>
int main(void) {
    const energy_parameters p = ENERGY_EXAMPLE;
    volatile double zero = 0.0;
    double F[9] = {1.3, 0.2, -0.1, 0.05, 0.9, 0.1, 0.02, -0.05, 1.1}, P[9];
    printf("%u ", energy_check(&p));
    printf("%u ", energy_stress(&p, F, P));
    printf("%.9g ", P[1]);
    F[4] = zero / zero;
    printf("%u", energy_stress(&p, F, P) & 4u);
    return 0;
}
