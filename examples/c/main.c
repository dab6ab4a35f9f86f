/*
 * An emitted energy in C: a tetrahedron that is turned inside out recovers. Newton's method brings it to rest in
 * 17 steps, with the gradient and the positive-semidefinite stiffness of `rubber_projected_tetrahedron`.
 *
 * One command prints the energy, one compiles it; the program links only the mathematical library of C:
 *
 *     cargo run --release -p piola-cli -- emit neo_hookean --extend 0.1 --target c --name rubber -o rubber.h
 *     cc -O3 -march=native -ffp-contract=off main.c -lm -o main && ./main
 *
 * `check` runs these commands with every installed compiler of C and C++. docs/emit.md describes the file.
 */
#include "rubber.h"
#include <stdio.h>

/* Solves K d = -g for three unknowns by Cramer's rule. */
static void solve(double K[3][3], const double g[3], double d[3]) {
    double cofactors[3][3], det = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
            cofactors[i][j] = K[a][c] * K[b][e] - K[a][e] * K[b][c];
        }
        det += K[0][i] * cofactors[0][i];
    }
    for (int j = 0; j < 3; j++) {
        d[j] = 0;
        for (int i = 0; i < 3; i++) d[j] -= cofactors[i][j] * g[i] / det;
    }
}

int main(void) {
    const rubber_parameters p = RUBBER_EXAMPLE;
    /* The inverse of Dm, 1/m, for edges of 0.1 m along the axes, and the volume, m^3. */
    const double rest[10] = {10, 0, 0, 0, 10, 0, 0, 0, 10, 1e-3 / 6};
    /* Node 3 has gone through the face of the others, which are held. */
    double x[12] = {0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0.02, 0.03, -0.08};
    double gradient[12], K[144];

    if (rubber_check(&p)) {
        puts("the parameters are not admissible");
        return 1;
    }
    for (int step = 0; step < 50; step++) {
        if (rubber_projected_tetrahedron(&p, x, rest, gradient, K) & 5) {
            puts("the energy refuses this shape: print the file with --extend 0.1");
            return 1;
        }
        const double force = fabs(gradient[9]) + fabs(gradient[10]) + fabs(gradient[11]);
        printf("step %2d: node 3 at height %8.5f m, force %.3e N\n", step, x[11], force);
        if (force < 1e-9) return 0;

        /* A semidefinite matrix may have no inverse; a little of its size does no harm. */
        double free[3][3], d[3], largest = 0;
        const double shift = 1e-3 * (K[9 * 12 + 9] + K[10 * 12 + 10] + K[11 * 12 + 11]) + 1e-9;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) free[i][j] = K[12 * (9 + i) + 9 + j];
            free[i][i] += shift * fmin(1, force);
        }
        solve(free, gradient + 9, d);
        for (int i = 0; i < 3; i++) largest = fmax(largest, fabs(d[i]));
        for (int i = 0; i < 3; i++) x[9 + i] += d[i] * fmin(1, 0.03 / largest);
    }
    puts("not at rest after 50 steps");
    return 1;
}
