#include <stdio.h>

#include "piola.h"

int main(void) {
    const double mu = 1e6, lambda = 4e6;
    const piola_parameter parameters[] = {{"mu", &mu, 1, 0}, {"lambda", &lambda, 1, 0}};
    /* A simple shear of 0.2. */
    const double F[9] = {1.0, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    double P[9], dP_dF[81];
    piola_survey survey;

    piola_energy *energy = NULL;
    piola_material *material = NULL;
    piola_code code = piola_energy_named("neo-Hookean", &energy);
    if (code == PIOLA_CODE_OK) code = piola_material_new(energy, parameters, 2, 0.0, 0, &material);
    if (code == PIOLA_CODE_OK) {
        code = piola_tangents(material, NULL, F, 9, P, 9, dP_dF, 81, &survey);
    }
    if (code == PIOLA_CODE_OK) {
        printf("P12 = %g Pa\n", P[1]);
    } else {
        fprintf(stderr, "%s\n", piola_error_message());
    }
    piola_material_free(material);
    piola_energy_free(energy);
    return code != PIOLA_CODE_OK;
}
