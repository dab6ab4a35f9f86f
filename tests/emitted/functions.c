#include "energy.h"
#include <stdio.h>
int main(void) {
    const energy_parameters p = ENERGY_EXAMPLE;
    FILE *from = fopen("points", "rb"), *to = fopen("results", "wb");
    const NUMBER rest[10] = REST;
    const NUMBER node[4] = {rest[3], rest[4], rest[5], rest[9]};
    NUMBER F[9], a[12], b[144], c[9], l[3], x[12] = {0};
    unsigned status = energy_check(&p);
    if (!from || !to || status) return 1;
    while (fread(F, sizeof(NUMBER), 9, from) == 9) {
#define PUT(n, x) fwrite(x, sizeof(NUMBER), n, to)
#define PUT_STATUS fwrite(&status, sizeof status, 1, to)
        status = energy_energy(&p, F, a), PUT(1, a), PUT_STATUS;
        status = energy_stress(&p, F, a), PUT(9, a), PUT_STATUS;
        status = energy_tangent(&p, F, a, b), PUT(9, a), PUT(81, b), PUT_STATUS;
        status = energy_projected(&p, F, a, b), PUT(9, a), PUT(81, b), PUT_STATUS;
        status = energy_absolute(&p, F, a, b), PUT(9, a), PUT(81, b), PUT_STATUS;
        status = energy_svd(&p, F, a, l, c), PUT(9, a), PUT(3, l), PUT(9, c), PUT_STATUS;
        status = energy_blocks(&p, l, b), PUT(15, b), PUT_STATUS;
        for (int k = 0; k < 9; k++) x[3 + k] = F[3 * (k % 3) + k / 3];
        status = energy_tetrahedron(&p, x, rest, a, b), PUT(12, a), PUT(144, b), PUT_STATUS;
        status = energy_projected_tetrahedron(&p, x, rest, a, b), PUT(12, a), PUT(144, b), PUT_STATUS;
        status = energy_vertex(&p, F, node, a, c), PUT(3, a), PUT(9, c), PUT_STATUS;
        status = energy_projected_vertex(&p, F, node, a, c), PUT(3, a), PUT(9, c), PUT_STATUS;
    }
    return fclose(to);
}
