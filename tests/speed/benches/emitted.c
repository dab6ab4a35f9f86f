#define _POSIX_C_SOURCE 199309L
#include "energy.h"
#include <stdio.h>
#include <time.h>
static double F[POINTS][9];
#define SWEEP(function) do { \
    struct timespec start, end; \
    double sum = 0; \
    clock_gettime(CLOCK_MONOTONIC, &start); \
    for (int sweep = 0; sweep < SWEEPS; sweep++) \
        for (int k = 0; k < POINTS; k++) { \
            double P[9], A[81]; \
            const unsigned status = function(&p, F[k], P, A); \
            sum += P[0] + A[80] + status; \
        } \
    clock_gettime(CLOCK_MONOTONIC, &end); \
    printf("%.17g ", ((double)(end.tv_sec - start.tv_sec) * 1e9 + (double)(end.tv_nsec - start.tv_nsec)) / POINTS / SWEEPS); \
    fprintf(stderr, "%g", sum); \
} while (0)
static __attribute__((noinline)) unsigned tangent(const energy_parameters *p, const double *F, double *P, double *A) {
    return energy_tangent(p, F, P, A);
}
static __attribute__((noinline)) unsigned projected(const energy_parameters *p, const double *F, double *P, double *A) {
    return energy_projected(p, F, P, A);
}
int main(void) {
    const energy_parameters p = ENERGY_EXAMPLE;
    FILE *points = fopen("points", "rb");
    if (!points || fread(F, sizeof F, 1, points) != 1) return 1;
    for (int turn = 0; turn < 3; turn++) {
        SWEEP(tangent);
        SWEEP(projected);
    }
    return 0;
}
