/* How long calls take: the least of several rounds, and what threads gain. */
#define _POSIX_C_SOURCE 200112L

#include "host.h"

#include <stdio.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <pthread.h>
#include <time.h>
#endif

enum { MOST_THREADS = 64, ROUNDS = 5 };

/* Monotonic seconds. */
static double now(void)
{
#ifdef _WIN32
    LARGE_INTEGER ticks, rate;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&rate);
    return (double)ticks.QuadPart / (double)rate.QuadPart;
#else
    struct timespec moment;
    clock_gettime(CLOCK_MONOTONIC, &moment);
    return (double)moment.tv_sec + 1e-9 * (double)moment.tv_nsec;
#endif
}

/* Print the least of several rounds, which is what the machine's other work disturbed least. */
static void print_time(const char *name, const double *seconds, long count)
{
    double least = seconds[0];
    int i;
    for (i = 1; i < ROUNDS; i++) least = seconds[i] < least ? seconds[i] : least;
    printf("%s %.2f ns\n", name, 1e9 * least / (double)count);
}

/* Time steps. */
void time_steps(Host *host, double size, long count)
{
    fmi2DoStepTYPE *call = host->library.step;
    double seconds[ROUNDS];
    int round;
    long i;
    for (round = 0; round < ROUNDS; round++) {
        double begin = now();
        unsigned answers = 0;
        for (i = 0; i < count; i++) {
            answers |= (unsigned)call(host->instance, host->time, size, fmi2True);
            host->time += size;
        }
        seconds[round] = now() - begin;
        check(host, "doStep", (fmi2Status)answers);
    }
    print_time("doStep", seconds, count);
}

/* Time reading some Reals at once. */
void time_get(Host *host, long count, const char *text)
{
    fmi2ValueReference references[MOST_REFERENCES];
    fmi2Real values[MOST_REFERENCES];
    size_t n = read_references(text, references);
    double seconds[ROUNDS];
    int round;
    long i;
    for (round = 0; round < ROUNDS; round++) {
        double begin = now();
        unsigned answers = 0;
        for (i = 0; i < count; i++) {
            answers |= (unsigned)host->library.get_real(host->instance, references, n, values);
        }
        seconds[round] = now() - begin;
        check(host, "getReal", (fmi2Status)answers);
    }
    print_time("getReal", seconds, count);
}

/* Time keeping a state aside in the same block and going back to it. */
void time_state(Host *host, long count)
{
    fmi2FMUstate state = NULL;
    double seconds[ROUNDS];
    int round;
    long i;
    for (round = 0; round < ROUNDS; round++) {
        double begin = now();
        unsigned answers = 0;
        for (i = 0; i < count; i++) {
            answers |= (unsigned)host->library.get_state(host->instance, &state);
            answers |= (unsigned)host->library.set_state(host->instance, state);
        }
        seconds[round] = now() - begin;
        check(host, "getFMUstate and setFMUstate", (fmi2Status)answers);
    }
    check(host, "freeFMUstate", host->library.free_state(host->instance, &state));
    print_time("state", seconds, count);
}

/* Time making and freeing instances. */
void time_instantiate(Host *host, long count)
{
    double seconds[ROUNDS];
    int round;
    long i;
    for (round = 0; round < ROUNDS; round++) {
        double begin = now();
        for (i = 0; i < count; i++) {
            fmi2Component one = instantiate(host);
            if (!one) host->surprises++;
            host->library.free_instance(one);
        }
        seconds[round] = now() - begin;
    }
    print_time("instantiate", seconds, count);
}

#ifdef _WIN32
/* Threads are timed where there is pthread. */
void time_threads(Host *host, long threads, double size, long count)
{
    (void)threads, (void)size, (void)count;
    printf("threads are not timed on Windows\n");
    host->surprises++;
}
#else
typedef struct Run {
    Host host;
    double size;
    long count;
} Run;

/* Let one instance take its steps. */
static void *run(void *argument)
{
    Run *one = argument;
    step(&one->host, one->size, one->count);
    return NULL;
}

/* Time several instances in turn and in threads. */
void time_threads(Host *host, long threads, double size, long count)
{
    static Run runs[MOST_THREADS];
    pthread_t handles[MOST_THREADS];
    double begin, in_turn;
    long i;
    if (threads < 1 || threads > MOST_THREADS) threads = MOST_THREADS;
    for (i = 0; i < threads; i++) {
        runs[i].host = *host;
        runs[i].host.surprises = 0;
        runs[i].host.instance = instantiate(host);
        runs[i].size = size;
        runs[i].count = count;
        start(&runs[i].host, 0.0);
    }
    begin = now();
    for (i = 0; i < threads; i++) run(&runs[i]);
    in_turn = now() - begin;
    begin = now();
    for (i = 0; i < threads; i++) pthread_create(&handles[i], NULL, run, &runs[i]);
    for (i = 0; i < threads; i++) pthread_join(handles[i], NULL);
    printf("threads %.2f times as fast\n", in_turn / (now() - begin));
    for (i = 0; i < threads; i++) {
        host->surprises += runs[i].host.surprises;
        host->library.free_instance(runs[i].host.instance);
    }
}
#endif
