#include "fuzz.h"

#include <float.h>
#include <math.h>

/* Next random number: xorshift64*, the same on every machine. */
static uint64_t next(Fuzz *fuzz)
{
    fuzz->luck ^= fuzz->luck >> 12;
    fuzz->luck ^= fuzz->luck << 25;
    fuzz->luck ^= fuzz->luck >> 27;
    return fuzz->luck * UINT64_C(0x2545F4914F6CDD1D);
}

/* A random number below a bound. */
uint64_t below(Fuzz *fuzz, uint64_t bound)
{
    return (next(fuzz) >> 11) % bound;
}

/* Whether something with so many chances in a hundred happens. */
int chance(Fuzz *fuzz, unsigned percent)
{
    return below(fuzz, 100) < percent;
}

/* A Real: often within what a range may be, sometimes as bad as it gets. */
double any_real(Fuzz *fuzz)
{
    const double bad[] = {
        NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, DBL_MIN, 5e-324, -0.0, 1e300, -1e18, 1e15, 2147483648.0,
    };
    const double good[] = {0.0, 1.0, 2.0, 3.0, 50.0, 293.15, 1e-3, 1e8, 1e3, -1.0};
    const double sizes[] = {1e-3, 1.0, 1e2, 1e4};
    double part = (double)below(fuzz, UINT64_C(1) << 40) / (double)(UINT64_C(1) << 40);
    if (chance(fuzz, 15)) return bad[below(fuzz, sizeof bad / sizeof *bad)];
    if (chance(fuzz, 50)) return good[below(fuzz, sizeof good / sizeof *good)];
    return (2.0 * part - 1.0) * sizes[below(fuzz, sizeof sizes / sizeof *sizes)];
}
