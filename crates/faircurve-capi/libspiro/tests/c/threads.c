/* usage: threads THREADS CONTOURS [once]: every thread draws as many contours of its own at once with the others; then,
   unless once is enough, all are drawn again one after the other: the sums of what came must be the same to the bit. */
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <spiroentrypoints.h>

typedef struct {
    bezctx base;
    uint64_t sum;
    long pieces;
} summer;

static void add(bezctx *bc, double value)
{
    summer *s = (summer *)bc;
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    s->sum = s->sum * 6364136223846793005u + bits;
}
static void moveto(bezctx *bc, double x, double y, int is_open) { add(bc, x), add(bc, y), add(bc, is_open); }
static void lineto(bezctx *bc, double x, double y) { ((summer *)bc)->pieces++, add(bc, x), add(bc, y); }
static void curveto(bezctx *bc, double a, double b, double c, double d, double x, double y)
{
    ((summer *)bc)->pieces++;
    add(bc, a), add(bc, b), add(bc, c), add(bc, d), add(bc, x), add(bc, y);
}
static void mark_knot(bezctx *bc, int knot) { add(bc, knot); }

static uint32_t next(uint32_t *state)
{
    *state ^= *state << 13, *state ^= *state >> 17, *state ^= *state << 5;
    return *state;
}

typedef struct {
    int seed, contours, failed;
    summer all;
} job;

static void *work(void *argument)
{
    static const char letters[] = "ooococov";
    job *j = argument;
    uint32_t state = 2463534242u + 977u * (uint32_t)j->seed;
    j->all = (summer){{moveto, lineto, NULL, curveto, mark_knot}, 0, 0};
    j->failed = 0;
    for (int i = 0; i < j->contours; i++) {
        int n = 3 + next(&state) % 10, closed = next(&state) % 2;
        spiro_cp *list = malloc((n + 1) * sizeof *list);
        for (int k = 0; k < n; k++) {
            /* Once round an ellipse, nudged. */
            double angle = 6.28 * k / n, radius = 250 + next(&state) % 60;
            list[k].x = 300 + radius * cos(angle);
            list[k].y = 400 + 1.3 * radius * sin(angle);
            list[k].ty = letters[next(&state) % 8];
        }
        if (closed)
            list[n] = (spiro_cp){0, 0, 'z'};
        else
            list[0].ty = '{', list[n - 1].ty = '}';
        j->failed += !TaggedSpiroCPsToBezier0(list, &j->all.base);
        free(list);
    }
    return NULL;
}

int main(int argc, char **argv)
{
    int threads = argc > 1 ? atoi(argv[1]) : 40, contours = argc > 2 ? atoi(argv[2]) : 1000;
    job *jobs = calloc(threads, sizeof *jobs);
    pthread_t *ids = calloc(threads, sizeof *ids);
    long pieces = 0, lost = 0, failed = 0;
    for (int i = 0; i < threads; i++) {
        jobs[i].seed = i, jobs[i].contours = contours;
        if (pthread_create(&ids[i], NULL, work, &jobs[i]))
            return 2;
    }
    for (int i = 0; i < threads; i++)
        pthread_join(ids[i], NULL);
    for (int i = 0; i < threads; i++) {
        pieces += jobs[i].all.pieces, failed += jobs[i].failed;
        if (argc > 3)
            continue;
        job alone = {i, contours, 0, {{0, 0, 0, 0, 0}, 0, 0}};
        work(&alone);
        lost += alone.all.sum != jobs[i].all.sum || alone.all.pieces != jobs[i].all.pieces;
    }
    printf("%d threads, %d contours each: %ld pieces, %ld answers of 0, %ld threads differ from alone\n", threads,
           contours, pieces, failed, lost);
    free(jobs), free(ids);
    return lost || failed;
}
