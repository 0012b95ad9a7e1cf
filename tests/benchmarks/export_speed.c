/* As export_speed.mjs. */
#include <stdio.h>
#include <time.h>
#include "balls.h"
static double x[COUNT][12];
int main(void)
{
    FILE *file = fopen("collisions", "rb");
    if (!file || fread(x, sizeof *x, COUNT, file) != COUNT)
        return 1;
    struct balls_body ball = balls_solid_sphere_by_mass(0.01, 0.01);
    double best = 1e9, sum = 0;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        clock_t start = clock();
        sum = 0;
        for (int i = 0; i < COUNT; ++i) {
            const double *a = x[i];
            struct balls_pair pair = {0.3, a[9], a[10], 0, 0, 0, (int)a[11]};
            struct balls_vector n = {a[0], a[1], a[2]}, v = {a[3], a[4], a[5]};
            struct balls_vector w = {a[6], a[7], a[8]};
            struct balls_collision hit = balls_bounce(pair, n, ball, v, w);
            sum += hit.velocity.x + hit.spin.y;
        }
        double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
        best = taken < best ? taken : best;
    }
    printf("%.17g %.17g\n", best, sum);
    return 0;
}
