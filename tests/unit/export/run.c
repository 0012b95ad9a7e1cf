/* Reads impacts from `in` and writes a row for each to `out`: of `velocity` and `rebound`, or with
   the word `collide` of that, and says what is wrong. TABLE is the name of a table. */
#include <stdio.h>
#include "TABLE.h"
static void rebound(const double *x, double *row)
{
    struct TABLE_result r = TABLE_rebound(x[0], x[1], x[2], x[3], (int)x[4]);
    row[0] = TABLE_velocity(x[0], x[1], x[2], x[3], (int)x[4]);
    row[1] = r.velocity;
    row[2] = r.peak_friction;
    row[3] = r.dissipation;
    row[4] = r.regime;
}
static struct TABLE_vector at(const double *x)
{
    struct TABLE_vector v = {x[0], x[1], x[2]};
    return v;
}
static void collide(const double *x, double *row)
{
    struct TABLE_pair pair = {x[0], x[1], x[2], x[3], x[4], x[5], (int)x[6]};
    struct TABLE_body body = {x[10], x[11], x[12]}, other = {x[19], x[20], x[21]};
    const struct TABLE_vector n = at(x + 7), v = at(x + 13), spin = at(x + 16);
    const struct TABLE_vector other_v = at(x + 22), other_spin = at(x + 25);
    const char *problem = TABLE_problem(pair, n, body, v, spin, other, other_v, other_spin);
    struct TABLE_collision r = TABLE_collide(pair, n, body, v, spin, other, other_v, other_spin);
    const struct TABLE_vector vectors[] = {
        r.velocity, r.spin, r.other_velocity, r.other_spin, r.impulse};
    int i;
    for (i = 0; i < 5; ++i) {
        row[3 * i] = vectors[i].x;
        row[3 * i + 1] = vectors[i].y;
        row[3 * i + 2] = vectors[i].z;
    }
    row[15] = r.incidence;
    row[16] = r.restitution;
    row[17] = r.error_bound;
    row[18] = r.regime;
    row[19] = TABLE_model_form(pair, n, body, v, spin, other, other_v, other_spin);
    row[20] = problem != NULL;
    if (problem)
        puts(problem);
}
int main(int count, char **words)
{
    double x[WIDTH], row[21];
    FILE *in = fopen("in", "rb"), *out = fopen("out", "wb");
    const int collides = words[1][0] == 'c';
    const size_t width = collides ? WIDTH : 5;
    if (!in || !out || count != 2)
        return 1;
    while (fread(x, sizeof x[0], width, in) == width) {
        (collides ? collide : rebound)(x, row);
        fwrite(row, sizeof row[0], collides ? 21 : 5, out);
    }
    return fclose(out);
}
