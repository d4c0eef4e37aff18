/* Kernels that use all they are given and trust nothing in it: every number of every array is read, and
 * written where it may be; ISA is the suffix. One call in ten or so fails, with any status. */
#include <stdint.h>
#include <string.h>

#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)

int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes);
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes);
int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time);
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h);
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h);

/* Mix the bits of numbers into a sum. */
static uint64_t mixed(uint64_t sum, const double *numbers, int64_t count)
{
    int64_t i;
    for (i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, numbers + i, sizeof bits);
        sum = (sum ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
        sum ^= sum >> 29;
    }
    return sum;
}

/* Fill numbers from a sum, NaN and the like among them. */
static void fill(double *numbers, int64_t count, uint64_t sum)
{
    int64_t i;
    for (i = 0; i < count; i++) {
        sum = sum * UINT64_C(6364136223846793005) + 1;
        if (sum >> 60) {
            numbers[i] = (double)(int64_t)sum * 1e-17;
        } else {
            memcpy(numbers + i, &sum, sizeof sum);
        }
    }
}

/* Fill the outputs. */
int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes)
{
    fill(z, sizes[3], mixed(mixed(1, p, sizes[0]), s, sizes[2]));
    return 0;
}

/* What init and step have in common. */
static int32_t work(const double *p, const double *u, double *s, double *z, double *w, const int64_t *sizes,
                    double number)
{
    uint64_t sum = mixed(mixed(mixed(2, p, sizes[0]), u, sizes[1]), s, sizes[2]);
    sum = mixed(sum, &number, 1);
    fill(w, sizes[4], sum);
    fill(s, sizes[2], sum + 1);
    fill(z, sizes[3], sum + 2);
    if (sum >> 61 == 0) return (int32_t)(sum >> 4 & 7) - 1;
    if (sum >> 56 == 255) return (int32_t)(uint32_t)(sum & 0x7fffffff);
    return NAME(fb_outputs_, ISA)(p, s, z, sizes);
}

/* Start. */
int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time)
{
    return work(p, u, s, z, w, sizes, time);
}

/* Step. */
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h)
{
    return work(p, u, s, z, w, sizes, h);
}

/* Derivatives. */
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h)
{
    return work(p, u, s, z, w, sizes, h);
}

/* Copy the state. */
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes)
{
    memcpy(kept, s, (size_t)sizes[2] * sizeof *s);
    return (int32_t)(mixed(1, p, sizes[0]) & 1);
}
