/* A careless host: random calls with random arguments on a library, and damaged files and states. */
#ifndef FUZZ_H
#define FUZZ_H

#include "fmi2Functions.h"

#include <stddef.h>
#include <stdint.h>

enum { MOST_VALUES = 8, MOST_STATES = 4, MOST_PATH = 2000 };

/* What the host was given, and what happened so far. */
typedef struct Fuzz {
    uint64_t luck; /* of the random numbers; never 0 */
    const char *guid;
    char good[MOST_PATH], bad[MOST_PATH], bad_file[MOST_PATH]; /* folders, and the file to damage */
    unsigned char *model; /* bytes of the good file */
    size_t model_size;
    int forge;          /* damage with the right checksum too; only kernels that trust nothing bear that */
    size_t n_variables; /* about so many value references are asked for */
    double usual_step;
    long logged;
    long answers[4]; /* how often each fmi2Status was answered */
    long steps, discarded_steps, forged_models, refused_models, forged_states, refused_states;
} Fuzz;

/* One instance, where it probably stands, and states kept aside. */
typedef struct Slave {
    fmi2Component instance;
    double time;
    fmi2FMUstate states[MOST_STATES];
} Slave;

/* A random number below a bound. */
uint64_t below(Fuzz *fuzz, uint64_t bound);

/* Whether something with so many chances in a hundred happens. */
int chance(Fuzz *fuzz, unsigned percent);

/* A Real: often within what a range may be, sometimes as bad as it gets. */
double any_real(Fuzz *fuzz);

/* Note the answer to a call; leaves the program where it is none that FMI knows, or an unexplained one. */
fmi2Status answer(Fuzz *fuzz, const char *call, fmi2Status status);

/* Leave the program because of what the library did. */
void give_up(const Fuzz *fuzz, const char *call, const char *what);

/* Make an instance on the resources in a folder; arguments are strange at times if that is wanted. */
fmi2Component make(Fuzz *fuzz, const char *folder, int strange);

/* One random call. */
void call_something(Fuzz *fuzz, Slave *slave);

/* Give the states kept aside and the instance back. */
void drop(Fuzz *fuzz, Slave *slave);

/* Make instances on a damaged file, and call some of their functions. */
void damage_model(Fuzz *fuzz);

/* Send the state of an instance as bytes and damage them on the way. */
void damage_state(Fuzz *fuzz, Slave *slave);

#endif
