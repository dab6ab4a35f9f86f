/* The functions of piola.h from C: values, and every kind of error. Prints what fails, and returns 1 then. */
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "piola.h"

static int failures = 0;

#define CHECK(holds)                                                                                         \
    do {                                                                                                     \
        if (!(holds)) {                                                                                      \
            printf(                                                                                          \
                "%s:%d: %s\n  the last message: %s\n", __FILE__, __LINE__, #holds, piola_error_message());   \
            failures++;                                                                                      \
        }                                                                                                    \
    } while (0)

#define LENGTH(array) (sizeof(array) / sizeof(array)[0])

/* The code is the expected one, and the message has this text in it. */
#define FAILS(call, code, text)                                                                              \
    do {                                                                                                     \
        CHECK((call) == (code));                                                                             \
        CHECK(strstr(piola_error_message(), (text)) != NULL);                                                \
    } while (0)

static const double MU = 1e6, LAMBDA = 4e6;

static piola_material *rubber(void) {
    const piola_parameter parameters[] = {{"mu", &MU, 1, 0}, {"lambda", &LAMBDA, 1, 0}};
    piola_energy *energy = NULL;
    piola_material *material = NULL;
    CHECK(piola_energy_named("neo-Hookean", &energy) == PIOLA_CODE_OK);
    CHECK(piola_material_new(energy, parameters, 2, 0.0, 0, &material) == PIOLA_CODE_OK);
    piola_energy_free(energy);
    return material;
}

static int close_to(double found, double expected, double tolerance) {
    return fabs(found - expected) <= tolerance * fmax(fabs(expected), 1.0);
}

/* A simple shear of 0.2: P12 = 0.2 mu. */
static const double SHEAR[9] = {1.0, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
static const double MIRRORED[9] = {-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

static void energies_are_described(void) {
    piola_energy *energy = NULL;
    const piola_energy_description *description = NULL;
    CHECK(piola_energy_named("OGDEN", &energy) == PIOLA_CODE_OK);
    CHECK(piola_energy_describe(energy, &description) == PIOLA_CODE_OK);
    CHECK(strcmp(description->name, "ogden") == 0 && description->parameter_count == 3);
    CHECK(strcmp(description->parameters[0].name, "mu") == 0 && description->parameters[0].is_list == 1);
    CHECK(description->parameters[2].is_list == 0);
    CHECK(strstr(description->parameters[2].documentation, "Pa") != NULL);
    CHECK(description->parameters[0].typical_length > 0);
    piola_energy_free(energy);
    FAILS(piola_energy_named("jelly", &energy), PIOLA_CODE_MATERIAL, "there is no material `jelly`");
    CHECK(energy == NULL);
    FAILS(piola_energy_named(NULL, &energy), PIOLA_CODE_POINTER, "`name` is null");
    FAILS(piola_energy_named("\xff\xfe", &energy), PIOLA_CODE_TEXT, "`name` is not UTF-8");
    FAILS(piola_energy_named("ogden", NULL), PIOLA_CODE_POINTER, "`energy` is null");
    FAILS(piola_energy_describe(NULL, &description), PIOLA_CODE_POINTER, "`energy` is null");
    piola_energy_free(NULL);
}

/* A formula, the same in Rust, and the catalogue have the same bits. */
static void energies_are_declared(void) {
    static const char *const texts[] = {
        "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2 where J > 0",
        "#[material(domain(J > 0.0))]\n"
        "fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {\n"
        "    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)\n"
        "}",
    };
    static const piola_notation notations[] = {PIOLA_NOTATION_FORMULA, PIOLA_NOTATION_RUST};
    const piola_parameter parameters[] = {{"lambda", &LAMBDA, 1, 0}, {"mu", &MU, 1, 0}};
    for (int k = 0; k < 2; k++) {
        piola_energy *energy = NULL;
        piola_material *material = NULL;
        CHECK(piola_energy_declared(texts[k], notations[k], &energy) == PIOLA_CODE_OK);
        CHECK(piola_material_new(energy, parameters, 2, 0.0, 0, &material) == PIOLA_CODE_OK);
        double P[9], mu, lambda;
        CHECK(piola_stresses(material, NULL, SHEAR, 9, P, 9, NULL) == PIOLA_CODE_OK);
        CHECK(close_to(P[1], 0.2 * MU, 1e-12));
        CHECK(piola_material_moduli(material, &mu, &lambda) == PIOLA_CODE_OK);
        CHECK(close_to(mu, MU, 1e-14) && close_to(lambda, LAMBDA, 1e-14));
        piola_material_free(material);
        piola_energy_free(energy);
    }
    piola_energy *energy = NULL;
    FAILS(piola_energy_declared("mu/2*(I1 - 3", 1, &energy), PIOLA_CODE_ENERGY, "mu/2*(I1 - 3");
    FAILS(piola_energy_declared("fn f() {}", 0, &energy), PIOLA_CODE_ENERGY, "");
    FAILS(
        piola_energy_declared("I1", 7, &energy), PIOLA_CODE_VALUE,
        "`notation` is 7; it must be one of 0 to 1");
    FAILS(piola_energy_declared(NULL, 0, &energy), PIOLA_CODE_POINTER, "`text` is null");
    CHECK(energy == NULL);
}

static void parameters_are_checked(void) {
    const double minus = -1.0, nan = NAN;
    piola_energy *energy = NULL;
    piola_material *material = NULL;
    CHECK(piola_energy_named("neo_hookean", &energy) == PIOLA_CODE_OK);
    piola_parameter parameters[] = {{"mu", &MU, 1, 0}, {"lambda", &LAMBDA, 1, 0}};
    FAILS(
        piola_material_new(energy, parameters, 1, 0.0, 0, &material), PIOLA_CODE_MATERIAL,
        "needs a value for `lambda`");
    parameters[1].name = "lame";
    FAILS(
        piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_MATERIAL,
        "has no parameter `lame`");
    parameters[1].name = NULL;
    FAILS(piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_POINTER, "is null");
    parameters[1].name = "lambda";
    parameters[0].values = &minus;
    FAILS(piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_MATERIAL, "mu");
    parameters[0].values = &nan;
    FAILS(
        piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_MATERIAL,
        "it must be a finite number");
    parameters[0].values = NULL;
    FAILS(piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_POINTER, "`mu` is null");
    parameters[0].values = &MU;
    FAILS(
        piola_material_new(energy, parameters, 2, 1.5, 0, &material), PIOLA_CODE_MATERIAL, "epsilon is 1.5");
    FAILS(piola_material_new(energy, parameters, 2, nan, 0, &material), PIOLA_CODE_MATERIAL, "epsilon");
    FAILS(piola_material_new(energy, NULL, 2, 0.0, 0, &material), PIOLA_CODE_POINTER, "`parameters` is null");
    FAILS(piola_material_new(NULL, parameters, 2, 0.0, 0, &material), PIOLA_CODE_POINTER, "`energy` is null");
    parameters[0].stride = 1;
    FAILS(piola_material_new(energy, parameters, 2, 0.0, 0, &material), PIOLA_CODE_LENGTH, "stride");
    CHECK(material == NULL);
    piola_energy_free(energy);
    piola_material_free(NULL);
}

/* One value of mu for each point: the stress of each is that of its own material. */
static void parameters_may_vary(void) {
    enum { POINTS = 19 };
    double mu[2 * POINTS], F[9 * POINTS], P[9 * POINTS];
    for (int p = 0; p < POINTS; p++) {
        mu[2 * p] = 1e6 * (p + 1);
        mu[2 * p + 1] = NAN;
        memcpy(F + 9 * p, SHEAR, sizeof SHEAR);
    }
    const piola_parameter parameters[] = {{"mu", mu, 1, 2}, {"lambda", &LAMBDA, 1, 0}};
    piola_energy *energy = NULL;
    piola_material *material = NULL;
    CHECK(piola_energy_named("neo_hookean", &energy) == PIOLA_CODE_OK);
    CHECK(piola_material_new(energy, parameters, 2, 0.0, POINTS, &material) == PIOLA_CODE_OK);
    CHECK(piola_stresses(material, NULL, F, 9 * POINTS, P, 9 * POINTS, NULL) == PIOLA_CODE_OK);
    for (int p = 0; p < POINTS; p++) CHECK(close_to(P[9 * p + 1], 0.2 * mu[2 * p], 1e-12));
    FAILS(piola_stresses(material, NULL, F, 9, P, 9, NULL), PIOLA_CODE_LENGTH, "`materials` has 19 entries");
    piola_material_free(material);
    mu[2 * 7] = -1.0;
    FAILS(
        piola_material_new(energy, parameters, 2, 0.0, POINTS, &material), PIOLA_CODE_MATERIAL,
        "point 7 (from 0)");
    CHECK(material == NULL);
    piola_energy_free(energy);
}

/* Energies, stresses and tangents of batches in both layouts: differences of the energy are the stress, those of
   the stress the tangent, which is symmetric. */
static void batches_are_derivatives(void) {
    enum { POINTS = 16 };
    piola_material *material = rubber();
    double F[9 * POINTS], energies[POINTS], P[9 * POINTS], P2[9 * POINTS], T[81 * POINTS];
    for (int k = 0; k < 9 * POINTS; k++) F[k] = SHEAR[k % 9] + 0.05 * sin(3.0 * k);
    piola_survey survey;
    CHECK(piola_energies(material, NULL, F, LENGTH(F), energies, POINTS, NULL) == PIOLA_CODE_OK);
    CHECK(
        piola_tangents(material, NULL, F, LENGTH(F), P, LENGTH(P), T, LENGTH(T), &survey) == PIOLA_CODE_OK);
    CHECK(survey.refused == 0 && survey.nonfinite == 0 && survey.first == SIZE_MAX);
    CHECK(piola_stresses(material, NULL, F, LENGTH(F), P2, LENGTH(P2), NULL) == PIOLA_CODE_OK);
    for (int k = 0; k < 9 * POINTS; k++) CHECK(close_to(P[k], P2[k], 1e-12 * MU));
    for (int p = 0; p < POINTS; p++) {
        for (int r = 0; r < 9; r++) {
            for (int c = 0; c < 9; c++) {
                CHECK(T[81 * p + 9 * r + c] == T[81 * p + 9 * c + r]);
            }
        }
    }
    /* Central differences in direction k, whose error is of the order of h^2. */
    const double h = 1e-5;
    for (int k = 0; k < 9; k++) {
        double ahead[9 * POINTS], behind[9 * POINTS], P_ahead[9 * POINTS], P_behind[9 * POINTS];
        double e_ahead[POINTS], e_behind[POINTS];
        for (int i = 0; i < 9 * POINTS; i++) {
            ahead[i] = F[i] + (i % 9 == k ? h : 0.0);
            behind[i] = F[i] - (i % 9 == k ? h : 0.0);
        }
        CHECK(piola_energies(material, NULL, ahead, LENGTH(F), e_ahead, POINTS, NULL) == PIOLA_CODE_OK);
        CHECK(piola_energies(material, NULL, behind, LENGTH(F), e_behind, POINTS, NULL) == PIOLA_CODE_OK);
        CHECK(piola_stresses(material, NULL, ahead, LENGTH(F), P_ahead, LENGTH(P), NULL) == PIOLA_CODE_OK);
        CHECK(piola_stresses(material, NULL, behind, LENGTH(F), P_behind, LENGTH(P), NULL) == PIOLA_CODE_OK);
        for (int p = 0; p < POINTS; p++) {
            CHECK(fabs((e_ahead[p] - e_behind[p]) / (2 * h) - P[9 * p + k]) <= 1e-5 * MU);
            for (int r = 0; r < 9; r++) {
                const double slope = (P_ahead[9 * p + r] - P_behind[9 * p + r]) / (2 * h);
                CHECK(fabs(slope - T[81 * p + 9 * r + k]) <= 1e-5 * LAMBDA);
            }
        }
    }

    /* Lines, and single precision. */
    piola_options options = {sizeof options, 0, 0, 0, 0, NULL, 0};
    double lines[9 * POINTS], in_lines[9 * POINTS];
    float single[9 * POINTS], P_single[9 * POINTS], T_single[81 * POINTS], e_single[POINTS];
    for (int p = 0; p < POINTS; p++) {
        for (int k = 0; k < 9; k++) {
            lines[(p / 8 * 9 + k) * 8 + p % 8] = F[9 * p + k];
            single[9 * p + k] = (float)F[9 * p + k];
        }
    }
    options.layout = PIOLA_LAYOUT_LINES;
    options.threads = 1;
    CHECK(
        piola_stresses(material, &options, lines, LENGTH(lines), in_lines, LENGTH(in_lines), NULL) ==
        PIOLA_CODE_OK);
    CHECK(
        piola_energies_f32(material, NULL, single, LENGTH(single), e_single, POINTS, NULL) == PIOLA_CODE_OK);
    CHECK(
        piola_tangents_f32(
            material, NULL, single, LENGTH(single), P_single, LENGTH(P_single), T_single, LENGTH(T_single),
            NULL) == PIOLA_CODE_OK);
    for (int p = 0; p < POINTS; p++) {
        CHECK(fabs(e_single[p] - energies[p]) <= 1e-5 * LAMBDA);
        for (int k = 0; k < 9; k++) {
            CHECK(fabs(in_lines[(p / 8 * 9 + k) * 8 + p % 8] - P[9 * p + k]) <= 1e-12 * LAMBDA);
            CHECK(fabs(P_single[9 * p + k] - P[9 * p + k]) <= 1e-5 * LAMBDA);
        }
        for (int k = 0; k < 81; k++) CHECK(fabs(T_single[81 * p + k] - T[81 * p + k]) <= 1e-4 * LAMBDA);
    }
    options.layout = PIOLA_LAYOUT_LINES;
    FAILS(
        piola_stresses(material, &options, F, 9 * 15, P, 9 * 15, NULL), PIOLA_CODE_LENGTH,
        "multiple of 8 points");
    piola_material_free(material);
}

/* sigma = mu/J (F F^T - I) + lambda ln J/J, and for the shear c1212 of the Jaumann rate mu (1 + g^2/2). */
static void other_measures_are_those_of_books(void) {
    piola_material *material = rubber();
    double sigma[6], tangent[36], alone[6];
    CHECK(
        piola_stresses_in(material, NULL, PIOLA_MEASURE_JAUMANN, SHEAR, 9, sigma, 6, tangent, 36, NULL) ==
        PIOLA_CODE_OK);
    CHECK(close_to(sigma[0], 0.04 * MU, 1e-9) && close_to(sigma[5], 0.2 * MU, 1e-9) && fabs(sigma[1]) < 1e-6);
    CHECK(close_to(tangent[35], MU * (1.0 + 0.02), 1e-9));
    CHECK(
        piola_stresses_in(material, NULL, PIOLA_MEASURE_CAUCHY, SHEAR, 9, alone, 6, NULL, 0, NULL) ==
        PIOLA_CODE_OK);
    for (int k = 0; k < 6; k++) CHECK(fabs(alone[k] - sigma[k]) <= 1e-9 * MU);
    FAILS(
        piola_stresses_in(material, NULL, 5, SHEAR, 9, sigma, 6, NULL, 0, NULL), PIOLA_CODE_VALUE,
        "`measure` is 5");
    FAILS(
        piola_stresses_in(material, NULL, -1, SHEAR, 9, sigma, 6, NULL, 0, NULL), PIOLA_CODE_VALUE,
        "`measure` is -1");
    const float F[9] = {1.0f, 0.2f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f};
    float single[6];
    CHECK(
        piola_stresses_in_f32(material, NULL, PIOLA_MEASURE_CAUCHY, F, 9, single, 6, NULL, 0, NULL) ==
        PIOLA_CODE_OK);
    CHECK(fabs(single[5] - 0.2 * MU) <= 1e-5 * MU);
    piola_material_free(material);
}

static void points_have_statuses(void) {
    piola_material *material = rubber();
    double F[27], P[27];
    uint8_t statuses[3] = {255, 255, 255};
    memcpy(F, SHEAR, sizeof SHEAR);
    memcpy(F + 9, MIRRORED, sizeof MIRRORED);
    memcpy(F + 18, SHEAR, sizeof SHEAR);
    F[18] = NAN;
    piola_options options = {
        sizeof options, PIOLA_FILTER_CLAMP, 0, PIOLA_INSTRUCTIONS_PORTABLE, 0, statuses, 3};
    piola_survey survey;
    CHECK(piola_stresses(material, &options, F, 27, P, 27, &survey) == PIOLA_CODE_OK);
    CHECK(statuses[0] == 0 && (statuses[1] & PIOLA_STATUS_REFUSED) && (statuses[2] & PIOLA_STATUS_NONFINITE));
    CHECK(survey.refused >= 1 && survey.nonfinite >= 1 && survey.first == 1);
    options.statuses_length = 2;
    FAILS(
        piola_stresses(material, &options, F, 27, P, 27, &survey), PIOLA_CODE_LENGTH,
        "`statuses` has 2 entries");
    options.statuses = (uint8_t *)P;
    FAILS(piola_stresses(material, &options, F, 27, P, 27, &survey), PIOLA_CODE_POINTER, "`P` overlaps");
    piola_material_free(material);
}

static void calls_are_checked(void) {
    piola_material *material = rubber();
    double F[18], P[18];
    memcpy(F, SHEAR, sizeof SHEAR);
    memcpy(F + 9, SHEAR, sizeof SHEAR);
    FAILS(piola_stresses(NULL, NULL, F, 9, P, 9, NULL), PIOLA_CODE_POINTER, "`material` is null");
    FAILS(piola_stresses(material, NULL, NULL, 9, P, 9, NULL), PIOLA_CODE_POINTER, "`F` is null");
    FAILS(piola_stresses(material, NULL, F, 9, NULL, 9, NULL), PIOLA_CODE_POINTER, "`P` is null");
    FAILS(piola_stresses(material, NULL, F, 18, P, 9, NULL), PIOLA_CODE_LENGTH, "`P` has 9 entries");
    FAILS(piola_stresses(material, NULL, F, 10, P, 9, NULL), PIOLA_CODE_LENGTH, "`F` has 10 entries");
    FAILS(piola_stresses(material, NULL, F, 9, F, 9, NULL), PIOLA_CODE_POINTER, "`P` overlaps another array");
    FAILS(
        piola_stresses(material, NULL, F, SIZE_MAX / 2, P, 9, NULL), PIOLA_CODE_LENGTH,
        "more than memory can hold");
    FAILS(
        piola_stresses(material, NULL, (double *)((char *)F + 1), 9, P, 9, NULL), PIOLA_CODE_POINTER,
        "not aligned");
    FAILS(piola_tangents(material, NULL, F, 9, P, 9, P + 9, 9, NULL), PIOLA_CODE_LENGTH, "`dP_dF` has 9 entries");
    CHECK(piola_stresses(material, NULL, NULL, 0, NULL, 0, NULL) == PIOLA_CODE_OK);
    piola_options options = {sizeof options, 3, 0, 0, 0, NULL, 0};
    FAILS(piola_stresses(material, &options, F, 9, P, 9, NULL), PIOLA_CODE_VALUE, "`options->filter` is 3");
    options.filter = 0;
    options.layout = -1;
    FAILS(piola_stresses(material, &options, F, 9, P, 9, NULL), PIOLA_CODE_VALUE, "`options->layout` is -1");
    options.size = 4;
    FAILS(piola_stresses(material, &options, F, 9, P, 9, NULL), PIOLA_CODE_VALUE, "`options->size` is 4");
    piola_material_free(material);
}

/* Two tetrahedra that share a face. */
static const double REST[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
static const size_t CORNERS[8] = {0, 1, 2, 3, 4, 2, 1, 3};

/* All entries of a matrix of five nodes. */
static void dense(int32_t *starts, int32_t *columns) {
    for (int r = 0; r < 15; r++) {
        for (int c = 0; c < 15; c++) columns[15 * r + c] = c;
        starts[r] = 15 * r;
    }
    starts[15] = 15 * 15;
}

/* The gradient of a body is the sum of those of its elements, and differences of the energy. */
static void elements_and_bodies_agree(void) {
    piola_material *material = rubber();
    double rest[20], x[15], gradients[24], stiffnesses[288], F[18], other[24], entries[288];
    CHECK(piola_rest_shapes(REST, 15, CORNERS, 8, rest, 20) == PIOLA_CODE_OK);
    CHECK(close_to(rest[9], 1.0 / 6.0, 1e-14) && close_to(rest[19], 1.0 / 3.0, 1e-14));
    for (int k = 0; k < 15; k++) x[k] = REST[k] + 0.03 * sin(2.0 * k);
    CHECK(
        piola_stiffnesses_at(
            material, NULL, x, 15, CORNERS, 8, rest, 20, gradients, 24, stiffnesses, 288, NULL) ==
        PIOLA_CODE_OK);
    for (int t = 0; t < 2; t++) {
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                double sum = 0.0;
                for (int n = 0; n < 3; n++)
                    sum += (x[3 * CORNERS[4 * t + n + 1] + a] - x[3 * CORNERS[4 * t] + a]) *
                           rest[10 * t + 3 * n + b];
                F[9 * t + 3 * a + b] = sum;
            }
        }
    }
    CHECK(
        piola_stiffnesses(material, NULL, F, 18, rest, 20, other, 24, entries, 288, NULL) ==
        PIOLA_CODE_OK);
    for (int k = 0; k < 24; k++) CHECK(fabs(gradients[k] - other[k]) <= 1e-10 * MU);
    for (int k = 0; k < 288; k++) CHECK(fabs(entries[k] - stiffnesses[k]) <= 1e-10 * MU);

    int32_t starts[16], columns[225];
    int64_t starts_64[16], columns_64[225];
    double values[225] = {0.0}, again[225] = {0.0};
    piola_csr *csr = NULL;
    dense(starts, columns);
    CHECK(piola_csr_new_i32(5, CORNERS, 8, NULL, 0, starts, 16, columns, 225, &csr) == PIOLA_CODE_OK);
    CHECK(piola_csr_add(csr, 0, stiffnesses, 288, values, 225) == PIOLA_CODE_OK);
    FAILS(
        piola_csr_add(csr, 0, stiffnesses, 287, values, 225), PIOLA_CODE_LENGTH,
        "`stiffnesses` has 287 entries");
    piola_csr_free(csr);
    for (int k = 0; k < 16; k++) starts_64[k] = starts[k];
    for (int k = 0; k < 225; k++) columns_64[k] = columns[k];
    CHECK(piola_csr_new_i64(5, CORNERS, 8, NULL, 0, starts_64, 16, columns_64, 225, &csr) == PIOLA_CODE_OK);
    CHECK(piola_csr_add(csr, 0, stiffnesses, 288, again, 225) == PIOLA_CODE_OK);
    CHECK(memcmp(values, again, sizeof values) == 0);
    piola_csr_free(csr);
    columns[0] = -1;
    FAILS(
        piola_csr_new_i32(5, CORNERS, 8, NULL, 0, starts, 16, columns, 225, &csr), PIOLA_CODE_MATRIX,
        "row 0 and column 0");
    CHECK(csr == NULL);
    const size_t unknowns[5] = {PIOLA_NO_UNKNOWN, 0, 3, 6, 9};
    CHECK(piola_csr_new_i32(5, CORNERS, 8, unknowns, 5, starts, 13, columns, 180, &csr) == PIOLA_CODE_MATRIX);
    columns[0] = 0;
    CHECK(piola_csr_new_i32(5, CORNERS, 8, unknowns, 5, starts, 13, columns, 180, &csr) == PIOLA_CODE_OK);
    piola_csr_free(csr);
    FAILS(
        piola_csr_new_i32(5, CORNERS, 8, unknowns, 4, starts, 13, columns, 180, &csr), PIOLA_CODE_LENGTH,
        "`unknowns` has 4 entries");
    FAILS(
        piola_csr_new_i32(4, CORNERS, 8, NULL, 0, starts, 16, columns, 225, &csr), PIOLA_CODE_VALUE,
        "names node 4");

    piola_body *body = NULL;
    piola_response *response = NULL;
    piola_survey survey;
    const size_t part_of[2] = {1, 0};
    const piola_part parts[2] = {{material, 1000.0}, {material, 2000.0}};
    CHECK(piola_body_new(REST, 15, CORNERS, 8, part_of, 2, parts, 2, &body) == PIOLA_CODE_OK);
    double masses[5], total = 0.0;
    CHECK(piola_body_masses(body, masses, 5) == PIOLA_CODE_OK);
    for (int n = 0; n < 5; n++) total += masses[n];
    CHECK(close_to(total, 2000.0 / 6.0 + 1000.0 / 3.0, 1e-13));
    CHECK(piola_response_new(body, &response) == PIOLA_CODE_OK);
    double energy, gradient[15], sum[15] = {0.0};
    CHECK(piola_response_evaluate(response, x, 15, &energy, gradient, 15, &survey) == PIOLA_CODE_OK);
    CHECK(survey.first == SIZE_MAX);
    for (int t = 0; t < 2; t++) {
        for (int k = 0; k < 12; k++) sum[3 * CORNERS[4 * t + k / 3] + k % 3] += gradients[12 * t + k];
    }
    const double h = 1e-6;
    for (int k = 0; k < 15; k++) {
        double y[15], ahead, behind;
        memcpy(y, x, sizeof x);
        y[k] += h;
        CHECK(piola_response_evaluate(response, y, 15, &ahead, NULL, 0, NULL) == PIOLA_CODE_OK);
        y[k] -= 2 * h;
        CHECK(piola_response_evaluate(response, y, 15, &behind, NULL, 0, NULL) == PIOLA_CODE_OK);
        CHECK(fabs((ahead - behind) / (2 * h) - gradient[k]) <= 1e-4 * MU);
        CHECK(fabs(sum[k] - gradient[k]) <= 1e-10 * MU);
    }
    FAILS(
        piola_response_evaluate(response, x, 14, &energy, NULL, 0, NULL), PIOLA_CODE_LENGTH,
        "`positions` has 14 entries");
    FAILS(
        piola_response_evaluate(response, x, 12, &energy, NULL, 0, NULL), PIOLA_CODE_LENGTH,
        "`positions` has 12 entries");
    /* The second tetrahedron is turned inside out: the survey counts in the order of the caller. */
    memset(x + 12, 0, 3 * sizeof *x);
    CHECK(piola_response_evaluate(response, x, 15, &energy, NULL, 0, &survey) == PIOLA_CODE_OK);
    CHECK(survey.refused == 1 && survey.first == 1);
    piola_response_free(response);
    piola_body_free(body);

    const size_t beyond[2] = {0, 2};
    FAILS(
        piola_body_new(REST, 15, CORNERS, 8, beyond, 2, parts, 2, &body), PIOLA_CODE_VALUE,
        "`part_of[1]` is 2");
    const piola_part weightless = {material, 0.0}, nothing = {NULL, 1.0};
    FAILS(
        piola_body_new(REST, 15, CORNERS, 8, NULL, 0, &weightless, 1, &body), PIOLA_CODE_BODY,
        "the density is 0");
    FAILS(piola_body_new(REST, 15, CORNERS, 8, NULL, 0, &nothing, 1, &body), PIOLA_CODE_POINTER, "material");
    FAILS(piola_body_new(REST, 15, CORNERS, 8, NULL, 0, NULL, 0, &body), PIOLA_CODE_LENGTH, "`part_of`");
    FAILS(piola_body_new(REST, 12, CORNERS, 8, NULL, 0, parts, 1, &body), PIOLA_CODE_BODY, "node 4");
    size_t reversed[8], turned = 9;
    memcpy(reversed, CORNERS, sizeof reversed);
    reversed[5] = CORNERS[6], reversed[6] = CORNERS[5];
    FAILS(
        piola_body_new(REST, 15, reversed, 8, NULL, 0, parts, 1, &body), PIOLA_CODE_BODY,
        "1 of 2 elements have their nodes in the order of a negative volume: 2; `turn_tets` swaps");
    CHECK(piola_turn_tets(REST, 15, reversed, 8, &turned) == PIOLA_CODE_OK);
    CHECK(turned == 1 && memcmp(reversed, CORNERS, sizeof reversed) == 0);
    FAILS(piola_turn_tets(REST, 15, reversed, 7, &turned), PIOLA_CODE_LENGTH, "`corners` has 7 entries");
    FAILS(piola_rest_shapes(REST, 15, CORNERS, 8, rest, 19), PIOLA_CODE_LENGTH, "`rest` has 19 entries");
    FAILS(piola_rest_shapes(REST, 15, CORNERS, 7, rest, 20), PIOLA_CODE_LENGTH, "`corners` has 7 entries");
    piola_material_free(material);
}

/* A plane z = level that pushes back with k/2 (z - level)^2 where a node is below it. */
struct ground {
    double level, stiffness;
    int calls_before_failure;
    piola_simulation *reentered;
    piola_code reentry;
};

static int32_t called(struct ground *ground) {
    return ground->calls_before_failure > 0 && --ground->calls_before_failure == 0 ? 42 : 0;
}

static int32_t ground_energy(void *context, const double *x, size_t nodes, double *energy) {
    struct ground *ground = context;
    *energy = 0.0;
    for (size_t n = 0; n < nodes; n++)
        *energy += 0.5 * ground->stiffness * pow(fmin(x[3 * n + 2] - ground->level, 0.0), 2);
    if (ground->reentered != NULL) {
        double positions[15];
        ground->reentry = piola_simulation_read(ground->reentered, PIOLA_QUANTITY_POSITIONS, positions, 15);
    }
    return called(ground);
}

static int32_t ground_gradient(void *context, const double *x, size_t nodes, double *gradient) {
    struct ground *ground = context;
    for (size_t n = 0; n < nodes; n++)
        gradient[3 * n + 2] += ground->stiffness * fmin(x[3 * n + 2] - ground->level, 0.0);
    return called(ground);
}

/* The force instead of the gradient. */
static int32_t ground_force(void *context, const double *x, size_t nodes, double *gradient) {
    struct ground *ground = context;
    for (size_t n = 0; n < nodes; n++)
        gradient[3 * n + 2] -= ground->stiffness * fmin(x[3 * n + 2] - ground->level, 0.0);
    return 0;
}

static int32_t ground_blocks(void *context, const double *x, size_t nodes, piola_blocks *blocks) {
    struct ground *ground = context;
    const double entries[9] = {0, 0, 0, 0, 0, 0, 0, 0, ground->stiffness};
    for (size_t n = 0; n < nodes; n++) {
        if (x[3 * n + 2] < ground->level) CHECK(piola_blocks_add(blocks, n, n, entries) == PIOLA_CODE_OK);
    }
    return called(ground);
}

static int32_t no_share(void *context, const double *x, const double *d, size_t nodes, double *share) {
    (void)context, (void)x, (void)d, (void)nodes;
    *share = NAN;
    return 0;
}

static void bodies_move(void) {
    piola_material *material = rubber();
    const piola_part part = {material, 1000.0};
    piola_body *body = NULL;
    piola_simulation *simulation = NULL;
    CHECK(piola_body_new(REST, 15, CORNERS, 8, NULL, 0, &part, 1, &body) == PIOLA_CODE_OK);
    /* A body that falls freely: x = -g h^2 after a step of implicit Euler. */
    CHECK(piola_simulation_new(body, NULL, 0, "{\"gravity\": [0, 0, -10]}", &simulation) == PIOLA_CODE_OK);
    piola_step_report report;
    CHECK(piola_simulation_step(simulation, 0.01, &report) == PIOLA_CODE_OK);
    CHECK(
        report.convergence == PIOLA_CONVERGENCE_TOLERANCE ||
        report.convergence == PIOLA_CONVERGENCE_ROUNDING);
    CHECK(close_to(report.min_det, 1.0, 1e-9));
    double x[15], v[15];
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_POSITIONS, x, 15) == PIOLA_CODE_OK);
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_VELOCITIES, v, 15) == PIOLA_CODE_OK);
    for (int n = 0; n < 5; n++) {
        CHECK(fabs(x[3 * n + 2] - REST[3 * n + 2] + 10 * 1e-4) < 1e-9 && fabs(v[3 * n + 2] + 0.1) < 1e-6);
    }

    /* A ground that holds it, and stops it. */
    struct ground ground = {-0.002, 1e6, 0, NULL, PIOLA_CODE_OK};
    const piola_term term = {&ground, ground_energy, ground_gradient, ground_blocks, NULL};
    CHECK(piola_simulation_set_terms(simulation, &term, 1) == PIOLA_CODE_OK);
    for (int k = 0; k < 20; k++) CHECK(piola_simulation_step(simulation, 0.01, &report) == PIOLA_CODE_OK);
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_POSITIONS, x, 15) == PIOLA_CODE_OK);
    CHECK(x[2] > -0.02 && report.terms > 0.0);
    /* Functions that fail end the step, whichever of them it is, and leave the state. */
    for (int calls = 1; calls <= 4; calls++) {
        ground.calls_before_failure = calls;
        FAILS(
            piola_simulation_step(simulation, 0.01, NULL), PIOLA_CODE_CALLBACK,
            "term 0 (from 0) has returned 42");
        double after[15];
        CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_POSITIONS, after, 15) == PIOLA_CODE_OK);
        CHECK(memcmp(x, after, sizeof x) == 0);
    }
    /* A function that calls back with the same handle is told so, and nothing waits for ever. */
    ground.calls_before_failure = 0;
    ground.reentered = simulation;
    CHECK(piola_simulation_step(simulation, 0.01, NULL) == PIOLA_CODE_OK);
    CHECK(ground.reentry == PIOLA_CODE_BUSY);
    piola_term incomplete = term;
    incomplete.add_gradient = NULL;
    FAILS(
        piola_simulation_set_terms(simulation, &incomplete, 1), PIOLA_CODE_POINTER,
        "`terms[].add_gradient` is null");
    /* A gradient of the wrong sign is not taken for rounding, and is found by differences. */
    piola_term wrong = term;
    wrong.add_gradient = ground_force;
    for (int k = 0; k < 15; k++) x[k] = REST[k] - (k % 3 == 2 ? 0.05 : 0.0);
    CHECK(piola_simulation_write(simulation, PIOLA_QUANTITY_POSITIONS, x, 15) == PIOLA_CODE_OK);
    CHECK(piola_simulation_check_terms(simulation, 0) == PIOLA_CODE_OK);
    piola_term stuck = term;
    stuck.longest_step = no_share;
    CHECK(piola_simulation_set_terms(simulation, &stuck, 1) == PIOLA_CODE_OK);
    FAILS(
        piola_simulation_step(simulation, 0.01, NULL), PIOLA_CODE_STEP,
        "the `longest_step` of a term is not above 0");
    CHECK(piola_simulation_set_terms(simulation, &wrong, 1) == PIOLA_CODE_OK);
    FAILS(
        piola_simulation_step(simulation, 0.01, NULL), PIOLA_CODE_STEP,
        "the gradient of term 0 (from 0) does not fit its energy");
    FAILS(
        piola_simulation_check_terms(simulation, 0), PIOLA_CODE_STEP,
        "term 0 (from 0): the gradient at node 0 (from 0) along z is 4");
    CHECK(piola_simulation_set_terms(simulation, NULL, 0) == PIOLA_CODE_OK);

    /* Pins, where they move to, and their forces, which balance the weight. */
    const size_t pins[3] = {2, 0, 1};
    CHECK(piola_simulation_write(simulation, PIOLA_QUANTITY_POSITIONS, REST, 15) == PIOLA_CODE_OK);
    CHECK(piola_simulation_set_pins(simulation, pins, 3) == PIOLA_CODE_OK);
    const double up[3] = {0.0, 0.0, 0.001};
    const size_t origin = 0;
    CHECK(piola_simulation_prescribe(simulation, &origin, 1, up, 3) == PIOLA_CODE_OK);
    CHECK(piola_simulation_equilibrate(simulation, &report) == PIOLA_CODE_OK);
    double reactions[9], weight = 0.0, masses[5];
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_REACTIONS, reactions, 9) == PIOLA_CODE_OK);
    CHECK(piola_body_masses(body, masses, 5) == PIOLA_CODE_OK);
    for (int n = 0; n < 5; n++) weight += 10 * masses[n];
    CHECK(fabs(reactions[2] + reactions[5] + reactions[8] - weight) <= 1e-4 * weight);
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_POSITIONS, x, 15) == PIOLA_CODE_OK);
    CHECK(x[2] == 0.001);

    /* A spring at the free node, and forces. */
    const piola_spring spring = {{4, 4, 4, 4}, {1, 0, 0, 0}, {1, 1, 2}, 1e4};
    CHECK(piola_simulation_set_springs(simulation, &spring, 1) == PIOLA_CODE_OK);
    double forces[15] = {0.0};
    forces[14] = 100.0;
    CHECK(piola_simulation_write(simulation, PIOLA_QUANTITY_FORCES, forces, 15) == PIOLA_CODE_OK);
    double z = x[14];
    CHECK(piola_simulation_equilibrate(simulation, &report) == PIOLA_CODE_OK);
    CHECK(piola_simulation_read(simulation, PIOLA_QUANTITY_POSITIONS, x, 15) == PIOLA_CODE_OK);
    CHECK(x[14] > z + 1e-4 && report.springs > 0.0);
    CHECK(piola_simulation_write(simulation, PIOLA_QUANTITY_FORCES, NULL, 0) == PIOLA_CODE_OK);
    CHECK(
        piola_simulation_read(simulation, PIOLA_QUANTITY_FORCES, forces, 15) == PIOLA_CODE_OK &&
        forces[14] == 0.0);

    FAILS(piola_simulation_step(simulation, -1.0, NULL), PIOLA_CODE_STEP, "the time step is -1 s");
    FAILS(piola_simulation_step(simulation, NAN, NULL), PIOLA_CODE_STEP, "time step");
    FAILS(piola_simulation_step(NULL, 0.01, NULL), PIOLA_CODE_POINTER, "`simulation` is null");
    FAILS(piola_simulation_read(simulation, 9, x, 15), PIOLA_CODE_VALUE, "`quantity` is 9");
    FAILS(piola_simulation_read(simulation, 0, x, 14), PIOLA_CODE_LENGTH, "`numbers` has 14 entries");
    FAILS(piola_simulation_write(simulation, PIOLA_QUANTITY_REACTIONS, x, 15), PIOLA_CODE_VALUE, "reactions");
    x[3] = NAN;
    FAILS(
        piola_simulation_write(simulation, PIOLA_QUANTITY_POSITIONS, x, 15), PIOLA_CODE_VALUE,
        "node 1 (from 0) is not finite");
    const size_t nowhere = 99;
    FAILS(piola_simulation_set_pins(simulation, &nowhere, 1), PIOLA_CODE_VALUE, "there is no node 99");
    FAILS(
        piola_simulation_prescribe(simulation, &nowhere, 1, up, 3), PIOLA_CODE_VALUE,
        "node 99 (from 0) is not pinned");
    FAILS(
        piola_simulation_set_settings(simulation, "{\"gravitas\": 1}"), PIOLA_CODE_VALUE,
        "unknown field `gravitas`");
    FAILS(piola_simulation_set_settings(simulation, "{"), PIOLA_CODE_VALUE, "");
    FAILS(
        piola_simulation_set_settings(simulation, "{\"newton\": {\"tolerance\": 2}}"), PIOLA_CODE_VALUE,
        "tolerance");
    CHECK(
        piola_simulation_set_settings(
            simulation, "{\"integrator\": \"sdirk2\", \"newton\": {\"filtering\": {\"always\": \"clamp\"}}}") ==
        PIOLA_CODE_OK);
    CHECK(piola_simulation_step(simulation, 0.001, NULL) == PIOLA_CODE_OK);
    piola_simulation_free(simulation);
    FAILS(
        piola_simulation_new(body, &nowhere, 1, NULL, &simulation), PIOLA_CODE_VALUE, "there is no node 99");
    CHECK(simulation == NULL);
    piola_body_free(body);
    piola_material_free(material);
}

/* What threads share. */
struct shared {
    const piola_material *material;
    const piola_response *response;
    piola_simulation *simulation;
};

static void *compute(void *context) {
    const struct shared *shared = context;
    for (int k = 0; k < 200; k++) {
        double P[9], energy;
        if (piola_stresses(shared->material, NULL, SHEAR, 9, P, 9, NULL) != PIOLA_CODE_OK ||
            !close_to(P[1], 0.2 * MU, 1e-12))
            return context;
        if (piola_response_evaluate(shared->response, REST, 15, &energy, NULL, 0, NULL) != PIOLA_CODE_OK ||
            fabs(energy) > 1e-6)
            return context;
        const piola_code code = piola_simulation_step(shared->simulation, 1e-4, NULL);
        if (code != PIOLA_CODE_OK && code != PIOLA_CODE_BUSY) return context;
        /* The message is that of this thread. */
        piola_energy *energy_handle;
        char name[32];
        snprintf(name, sizeof name, "jelly%d", k);
        if (piola_energy_named(name, &energy_handle) != PIOLA_CODE_MATERIAL ||
            strstr(piola_error_message(), name) == NULL)
            return context;
    }
    return NULL;
}

static void threads_share_handles(void) {
    enum { THREADS = 4 };
    piola_material *material = rubber();
    const piola_part part = {material, 1000.0};
    piola_body *body = NULL;
    piola_response *response = NULL;
    piola_simulation *simulation = NULL;
    CHECK(piola_body_new(REST, 15, CORNERS, 8, NULL, 0, &part, 1, &body) == PIOLA_CODE_OK);
    CHECK(piola_response_new(body, &response) == PIOLA_CODE_OK);
    CHECK(piola_simulation_new(body, NULL, 0, NULL, &simulation) == PIOLA_CODE_OK);
    struct shared shared = {material, response, simulation};
    pthread_t threads[THREADS];
    for (int k = 0; k < THREADS; k++) CHECK(pthread_create(&threads[k], NULL, compute, &shared) == 0);
    for (int k = 0; k < THREADS; k++) {
        void *failed = NULL;
        CHECK(pthread_join(threads[k], &failed) == 0 && failed == NULL);
    }
    piola_simulation_free(simulation);
    piola_response_free(response);
    piola_body_free(body);
    piola_material_free(material);
}

int main(void) {
    CHECK(strcmp(piola_error_message(), "") == 0);
    energies_are_described();
    energies_are_declared();
    parameters_are_checked();
    parameters_may_vary();
    batches_are_derivatives();
    other_measures_are_those_of_books();
    points_have_statuses();
    calls_are_checked();
    elements_and_bodies_agree();
    bodies_move();
    threads_share_handles();
    return failures != 0;
}
