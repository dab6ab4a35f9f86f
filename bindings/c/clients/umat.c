/*
 * UMAT of Abaqus/Standard: any energy of piola's catalogue as a user material.
 *
 *   *MATERIAL, NAME=NEO_HOOKEAN        CMNAME is the name of the energy, in any case
 *   *USER MATERIAL, CONSTANTS=2        PROPS are its parameters in the order of its declaration, in a
 *   1.E6, 4.E6                         consistent system of units; of lists all entries, one list after another
 *
 * For solids (NTENS = 6), plane strain and axial symmetry (NTENS = 4). STRESS is the Cauchy stress, DDSDDE the
 * tangent of the Jaumann rate of the Kirchhoff stress by deformed volume, SSE the energy by deformed volume. A
 * deformation outside the domain of the energy asks for an increment of a quarter.
 *
 * Compiled with CALCULIX defined, it is one for CalculiX, for materials whose names begin with ABAQUSNL, which
 * wants another stress and another tangent.
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "piola.h"

/* Abaqus' own: ends the analysis. */
void xit_(void);
#ifdef CALCULIX
/* CalculiX ends with this code after an error. */
void xit_(void) {
    exit(201);
}
#endif

/* A material that has been made: piola's are shared by all threads. */
struct known {
    char name[81];
    double *props;
    size_t nprops;
    piola_material *material;
    struct known *next;
};

static struct known *all = NULL;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* Makes the material: lists have one length, which the number of PROPS tells. */
static piola_code make(const char *name, const double *props, size_t nprops, piola_material **material) {
    piola_energy *energy = NULL;
    const piola_energy_description *description = NULL;
    piola_code code = piola_energy_named(name, &energy);
    if (code == PIOLA_CODE_OK) code = piola_energy_describe(energy, &description);
    if (code == PIOLA_CODE_OK) {
        const size_t count = description->parameter_count;
        size_t lists = 0;
        for (size_t k = 0; k < count; k++) lists += description->parameters[k].is_list != 0;
        const size_t length = lists > 0 && nprops > count - lists ? (nprops - (count - lists)) / lists : 1;
        /* One entry too many is given where PROPS are left over, which the library then names. */
        piola_parameter *parameters = calloc(count + 1, sizeof *parameters);
        size_t used = 0, given = 0;
        for (size_t k = 0; parameters != NULL && k < count; k++) {
            const size_t wanted = description->parameters[k].is_list != 0 ? length : 1;
            if (used + wanted > nprops) break;
            parameters[given++] = (piola_parameter){description->parameters[k].name, props + used, wanted, 0};
            used += wanted;
        }
        if (used < nprops)
            parameters[given++] = (piola_parameter){"PROPS left over", props + used, nprops - used, 0};
        code = piola_material_new(energy, parameters, given, 0.0, 0, material);
        free(parameters);
    }
    piola_energy_free(energy);
    return code;
}

/* The material of a name and its PROPS, made where it is new. */
static piola_code
find(const char *name, const double *props, size_t nprops, const piola_material **material) {
    piola_code code = PIOLA_CODE_OK;
    pthread_mutex_lock(&lock);
    struct known *known = all;
    while (known != NULL && (strcmp(known->name, name) != 0 || known->nprops != nprops ||
                             memcmp(known->props, props, nprops * sizeof *props) != 0)) {
        known = known->next;
    }
    if (known == NULL) {
        piola_material *made = NULL;
        code = make(name, props, nprops, &made);
        known = calloc(1, sizeof *known);
        if (code == PIOLA_CODE_OK && known != NULL &&
            (known->props = malloc(nprops * sizeof *props + 1)) != NULL) {
            snprintf(known->name, sizeof known->name, "%s", name);
            memcpy(known->props, props, nprops * sizeof *props);
            known->nprops = nprops;
            known->material = made;
            known->next = all;
            all = known;
        } else {
            free(known);
            piola_material_free(made);
            known = NULL;
        }
    }
    pthread_mutex_unlock(&lock);
    *material = known != NULL ? known->material : NULL;
    return code;
}

/* The cofactors of a matrix, and its determinant. */
static double cofactors(const double F[9], double C[9]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int below = 3 * ((i + 1) % 3), last = 3 * ((i + 2) % 3), right = (j + 1) % 3,
                      end = (j + 2) % 3;
            C[3 * i + j] = F[below + right] * F[last + end] - F[below + end] * F[last + right];
        }
    }
    return F[0] * C[0] + F[1] * C[1] + F[2] * C[2];
}

#ifdef CALCULIX
/*
 * CalculiX hands over F = R U, but wants the Cauchy stress turned back by R, which is that of U. It multiplies
 * DDSDDE by the inverse of U at each of its four indices and takes the product for dS/dE: right for the tangent
 * of the Lie derivative of the Kirchhoff stress of U.
 *
 * Replaces F by U, unless it is inverted, by Newton's method for R.
 */
static void turned_back(double F[9]) {
    double R[9], C[9], change = 1.0;
    memcpy(R, F, sizeof R);
    if (!(cofactors(F, C) > 0.0)) return;
    for (int round = 0; round < 50 && change > 1e-15; round++) {
        const double determinant = cofactors(R, C);
        change = 0.0;
        for (int k = 0; k < 9; k++) {
            const double next = (R[k] + C[k] / determinant) / 2.0;
            change = fmax(change, fabs(next - R[k]));
            R[k] = next;
        }
    }
    memcpy(C, F, sizeof C);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) F[3 * i + j] = R[i] * C[j] + R[3 + i] * C[3 + j] + R[6 + i] * C[6 + j];
    }
}
#endif

void umat_(
    double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,
    double *ddsddt, double *drplde, double *drpldt, const double *stran, const double *dstran,
    const double *time, const double *dtime, const double *temp, const double *dtemp, const double *predef,
    const double *dpred, const char *cmname, const int *ndi, const int *nshr, const int *ntens,
    const int *nstatv, const double *props, const int *nprops, const double *coords, const double *drot,
    double *pnewdt, const double *celent, const double *dfgrd0, const double *dfgrd1, const int *noel,
    const int *npt, const int *layer, const int *kspt, const int *jstep, const int *kinc,
    size_t cmname_length) {
    /* Where number I of Abaqus, 11, 22, 33, 12, 13, 23, is among those of piola. */
    static const int place[6] = {0, 1, 2, 5, 4, 3};
    (void)statev, (void)spd, (void)scd, (void)rpl, (void)ddsddt, (void)drplde, (void)drpldt, (void)stran,
        (void)dstran;
    (void)time, (void)dtime, (void)temp, (void)dtemp, (void)predef, (void)dpred, (void)nstatv, (void)coords,
        (void)drot;
    (void)celent, (void)dfgrd0, (void)noel, (void)npt, (void)layer, (void)kspt, (void)jstep, (void)kinc;

    char name[81] = "";
#ifdef CALCULIX
    /* It passes another type. */
    cmname_length = 80;
#endif
    while (cmname_length > 0 && cmname[cmname_length - 1] == ' ') cmname_length--;
    memcpy(name, cmname, cmname_length < 80 ? cmname_length : 80);
#ifdef CALCULIX
    /* Where it loads this from a library, the name of the library comes first. */
    const char *at = strrchr(name, '@');
    if (at != NULL) memmove(name, at + 1, strlen(at));
#endif
    if (*ndi != 3 || (*nshr != 3 && *nshr != 1) || *ntens != *ndi + *nshr) {
        fprintf(stderr, "%s: a material of piola is for solids, plane strain and axial symmetry\n", name);
        xit_();
        return;
    }
    const piola_material *material = NULL;
    piola_code code = find(name, props, *nprops > 0 ? (size_t)*nprops : 0, &material);

    /* Fortran has columns side by side, piola rows. */
    double F[9], C[9], stresses[6], tangents[36], energy = 0.0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) F[3 * i + j] = dfgrd1[i + 3 * j];
    }
#ifdef CALCULIX
    turned_back(F);
    const int32_t measure = PIOLA_MEASURE_KIRCHHOFF;
    const double by = cofactors(F, C);
#else
    const int32_t measure = PIOLA_MEASURE_JAUMANN;
    const double by = 1.0;
#endif
    piola_survey survey = {0, 0, 0, 0, 0};
    if (code == PIOLA_CODE_OK) code = piola_energies(material, NULL, F, 9, &energy, 1, NULL);
    if (code == PIOLA_CODE_OK) {
        code = piola_stresses_in(material, NULL, measure, F, 9, stresses, 6, tangents, 36, &survey);
    }
    if (code != PIOLA_CODE_OK) {
        fprintf(stderr, "%s\n", piola_error_message());
        xit_();
        return;
    }
    if (survey.refused + survey.nonfinite > 0) {
        *pnewdt = 0.25;
        return;
    }
    for (int i = 0; i < *ntens; i++) {
        stress[i] = stresses[place[i]] / by;
        for (int j = 0; j < *ntens; j++) ddsdde[i + *ntens * j] = tangents[6 * place[i] + place[j]];
    }
    *sse = energy / cofactors(F, C);
}
