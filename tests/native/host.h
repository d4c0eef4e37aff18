/* What a host of co-simulation FMUs calls and knows (host.c), and how it is timed (host_times.c). */
#ifndef HOST_H
#define HOST_H

#include "fmi2Functions.h"

#include <stddef.h>

enum { MOST_REFERENCES = 1000 };

typedef struct Library {
    fmi2InstantiateTYPE *instantiate;
    fmi2FreeInstanceTYPE *free_instance;
    fmi2SetupExperimentTYPE *setup;
    fmi2EnterInitializationModeTYPE *enter;
    fmi2ExitInitializationModeTYPE *exit;
    fmi2TerminateTYPE *terminate;
    fmi2ResetTYPE *reset;
    fmi2SetRealTYPE *set_real;
    fmi2GetRealTYPE *get_real;
    fmi2SetRealInputDerivativesTYPE *set_rate;
    fmi2DoStepTYPE *step;
    fmi2GetFMUstateTYPE *get_state;
    fmi2SetFMUstateTYPE *set_state;
    fmi2FreeFMUstateTYPE *free_state;
    fmi2SerializedFMUstateSizeTYPE *state_size;
    fmi2SerializeFMUstateTYPE *serialise;
    fmi2DeSerializeFMUstateTYPE *deserialise;
} Library;

typedef struct Host {
    Library library;
    const char *guid, *resources;
    fmi2Component instance;
    double time;
    fmi2Status expected;
    int surprises;
    int float_mode; /* place in the list of modes; 0: to nearest, as a process starts */
} Host;

/* Note whether a call answered as expected. */
fmi2Status check(Host *host, const char *call, fmi2Status status);

/* Make an instance. */
fmi2Component instantiate(const Host *host);

/* Carry an instance from instantiation to its first step. */
void start(Host *host, double time);

/* Take so many steps. */
void step(Host *host, double size, long count);

/* Read numbers with commas between them. */
size_t read_references(const char *text, fmi2ValueReference *found);

/* Time steps. */
void time_steps(Host *host, double size, long count);

/* Time reading some Reals at once. */
void time_get(Host *host, long count, const char *text);

/* Time keeping a state aside in the same block and going back to it. */
void time_state(Host *host, long count);

/* Time making and freeing instances. */
void time_instantiate(Host *host, long count);

/* Time several instances in turn and in threads. */
void time_threads(Host *host, long threads, double size, long count);

#endif
