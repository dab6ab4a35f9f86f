/* The time of a call: the energy of one point, ns, the best of many rounds. The same from Rust is the example
   `overhead` of the crate. */
#include <stdio.h>
#include <time.h>

#include "piola.h"

int main(void) {
    const double mu = 1e6, lambda = 4e6, F[9] = {1.0, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const piola_parameter parameters[] = {{"mu", &mu, 1, 0}, {"lambda", &lambda, 1, 0}};
    piola_energy *energy = NULL;
    piola_material *material = NULL;
    double psi, best = 1e9;
    piola_code code = piola_energy_named("neo_hookean", &energy);
    if (code == PIOLA_CODE_OK) code = piola_material_new(energy, parameters, 2, 0.0, 0, &material);
    for (int round = 0; round < 200 && code == PIOLA_CODE_OK; round++) {
        enum { CALLS = 10000 };
        piola_survey survey;
        struct timespec start, end;
        timespec_get(&start, TIME_UTC);
        for (int call = 0; call < CALLS; call++)
            code |= piola_energies(material, NULL, F, 9, &psi, 1, &survey);
        timespec_get(&end, TIME_UTC);
        const double time = 1e9 * (double)(end.tv_sec - start.tv_sec) + (double)(end.tv_nsec - start.tv_nsec);
        if (time / CALLS < best) best = time / CALLS;
    }
    if (code == PIOLA_CODE_OK) printf("%.1f\n", best);
    piola_material_free(material);
    piola_energy_free(energy);
    return code != PIOLA_CODE_OK;
}
