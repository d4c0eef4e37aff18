/* A host of co-simulation FMUs: host LIBRARY GUID RESOURCES COMMAND...
 *
 * Commands are carried out in turn on one instance:
 *   setup:T[:TOLERANCE] enter exit terminate reset     phases; start:T is the first three of them
 *   set:VR:VALUE  rate:VR:VALUE            a Real input, its first derivative
 *   step:H[:N]                             so many steps (1) of H seconds
 *   get:VR,...                             one line of Reals, every bit of them
 *   save:FILE  load:FILE                   the state as bytes
 *   time:T                                 where the master believes to stand
 *   float:MODE                             compute as nearest, up, down, zero or flush, as a host may
 *   expect:STATUS                          what the next call has to answer, 0 (fmi2OK) unless told
 *   time-step:H:N  time-get:N:VR,...  time-state:N  time-instantiate:N    nanoseconds for each call
 *   threads:K:H:N                          K instances in threads; how much faster than in turn
 * It leaves with 0 if every call answered as expected, 1 if one did not, 2 if it could not begin. */
#define _POSIX_C_SOURCE 200112L

#include "host.h"

#include <fenv.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

/* Print what the FMU says, with its arguments filled in. */
static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    va_list arguments;
    (void)environment;
    va_start(arguments, message);
    printf("log %d %s %s: ", (int)status, category, name);
    vprintf(message, arguments);
    printf("\n");
    va_end(arguments);
}

static const fmi2CallbackFunctions CALLBACKS = {logger, calloc, free, NULL, NULL};

/* Load a library; NULL with the reason printed. */
static void *load(const char *path)
{
#ifdef _WIN32
    void *library = (void *)LoadLibraryA(path);
    if (!library) fprintf(stderr, "%s: error %lu\n", path, GetLastError());
#else
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) fprintf(stderr, "%s\n", dlerror());
#endif
    return library;
}

/* Put the address of a function where it belongs; 0 if there is none of that name. */
static int find(void *library, const char *name, void *place)
{
#ifdef _WIN32
    FARPROC found = GetProcAddress((HMODULE)library, name);
#else
    void *found = dlsym(library, name);
#endif
    if (!found) fprintf(stderr, "the library has no %s\n", name);
    memcpy(place, &found, sizeof found);
    return found != NULL;
}

/* Find the functions the host uses. */
static int find_all(void *from, Library *to)
{
    return find(from, "fmi2Instantiate", &to->instantiate) && find(from, "fmi2FreeInstance", &to->free_instance) &&
           find(from, "fmi2SetupExperiment", &to->setup) &&
           find(from, "fmi2EnterInitializationMode", &to->enter) &&
           find(from, "fmi2ExitInitializationMode", &to->exit) && find(from, "fmi2Terminate", &to->terminate) &&
           find(from, "fmi2Reset", &to->reset) && find(from, "fmi2SetReal", &to->set_real) &&
           find(from, "fmi2GetReal", &to->get_real) &&
           find(from, "fmi2SetRealInputDerivatives", &to->set_rate) && find(from, "fmi2DoStep", &to->step) &&
           find(from, "fmi2GetFMUstate", &to->get_state) && find(from, "fmi2SetFMUstate", &to->set_state) &&
           find(from, "fmi2FreeFMUstate", &to->free_state) &&
           find(from, "fmi2SerializedFMUstateSize", &to->state_size) &&
           find(from, "fmi2SerializeFMUstate", &to->serialise) &&
           find(from, "fmi2DeSerializeFMUstate", &to->deserialise);
}

/* How a host may compute, and the library must not: rounding, and subnormal numbers as zero. */
static const struct {
    const char *name;
    int rounding, flush;
} FLOAT_MODES[] = {
    {"nearest", FE_TONEAREST, 0}, {"up", FE_UPWARD, 0},        {"down", FE_DOWNWARD, 0},
    {"zero", FE_TOWARDZERO, 0},   {"flush", FE_TONEAREST, 1},
};

enum { FLUSH = 0x8040 }; /* of MXCSR: results and operands */

/* Whether subnormal numbers are taken as zero, after that is changed to `flush` if it is not negative. */
static int flushes(int flush)
{
#ifdef __x86_64__
    if (flush >= 0) _mm_setcsr(flush ? _mm_getcsr() | FLUSH : _mm_getcsr() & ~(unsigned)FLUSH);
    return (_mm_getcsr() & FLUSH) == FLUSH;
#else
    return flush > 0;
#endif
}

/* Compute in a mode from now on; 0 if there is none of that name. */
static int float_mode(Host *host, const char *name)
{
    size_t i;
    for (i = 0; i < sizeof FLOAT_MODES / sizeof *FLOAT_MODES; i++) {
        if (strcmp(name, FLOAT_MODES[i].name) != 0) continue;
        fesetround(FLOAT_MODES[i].rounding);
        flushes(FLOAT_MODES[i].flush);
        host->float_mode = (int)i;
        return 1;
    }
    return 0;
}

/* Note whether a call left the mode as it was. */
static void check_float_mode(Host *host, const char *call)
{
    int rounding = FLOAT_MODES[host->float_mode].rounding, flush = FLOAT_MODES[host->float_mode].flush;
    int kept = fegetround() == rounding;
#ifdef __x86_64__
    kept = kept && flushes(-1) == flush;
#else
    (void)flush;
#endif
    if (!kept) {
        printf("%s changed how the host computes\n", call);
        host->surprises++;
    }
}

/* Note whether a call answered as expected. */
fmi2Status check(Host *host, const char *call, fmi2Status status)
{
    if (status != host->expected) {
        printf("%s answered %d instead of %d\n", call, (int)status, (int)host->expected);
        host->surprises++;
    }
    host->expected = fmi2OK;
    check_float_mode(host, call);
    return status;
}

/* Make an instance. */
fmi2Component instantiate(const Host *host)
{
    return host->library.instantiate("host", fmi2CoSimulation, host->guid, host->resources, &CALLBACKS, fmi2False,
                                     fmi2True);
}

/* Carry an instance from instantiation to its first step. */
void start(Host *host, double time)
{
    host->time = time;
    check(host, "setupExperiment", host->library.setup(host->instance, fmi2False, 0.0, time, fmi2False, 0.0));
    check(host, "enterInitializationMode", host->library.enter(host->instance));
    check(host, "exitInitializationMode", host->library.exit(host->instance));
}

/* Take so many steps. */
void step(Host *host, double size, long count)
{
    for (; count > 0; count--) {
        fmi2Status status = host->library.step(host->instance, host->time, size, fmi2True);
        if (check(host, "doStep", status) == fmi2OK) host->time += size;
    }
}

/* Read numbers with commas between them. */
size_t read_references(const char *text, fmi2ValueReference *found)
{
    size_t count = 0;
    char *end;
    while (count < MOST_REFERENCES) {
        unsigned long value = strtoul(text, &end, 10);
        if (end == text) break;
        found[count++] = (fmi2ValueReference)value;
        if (*end != ',') break;
        text = end + 1;
    }
    return count;
}

/* Print Reals. */
static void get(Host *host, const char *text)
{
    fmi2ValueReference references[MOST_REFERENCES];
    fmi2Real values[MOST_REFERENCES];
    size_t count = read_references(text, references);
    size_t i;
    check(host, "getReal", host->library.get_real(host->instance, references, count, values));
    for (i = 0; i < count; i++) printf(i ? " %.17g" : "%.17g", values[i]);
    printf("\n");
}

/* Write the state into a file. */
static void save(Host *host, const char *path)
{
    fmi2FMUstate state = NULL;
    size_t size = 0;
    fmi2Byte *bytes;
    FILE *file = fopen(path, "wb");
    check(host, "getFMUstate", host->library.get_state(host->instance, &state));
    check(host, "serializedFMUstateSize", host->library.state_size(host->instance, state, &size));
    bytes = malloc(size + 1);
    check(host, "serializeFMUstate", host->library.serialise(host->instance, state, bytes, size));
    if (!file || fwrite(bytes, 1, size, file) != size) host->surprises++;
    if (file) fclose(file);
    free(bytes);
    check(host, "freeFMUstate", host->library.free_state(host->instance, &state));
}

/* Go on from the state in a file; the time is the master's to know. */
static void restore(Host *host, const char *path)
{
    fmi2FMUstate state = NULL;
    fmi2Byte *bytes;
    size_t size;
    FILE *file = fopen(path, "rb");
    if (!file) {
        host->surprises++;
        return;
    }
    fseek(file, 0, SEEK_END);
    size = (size_t)ftell(file);
    fseek(file, 0, SEEK_SET);
    bytes = malloc(size + 1);
    if (fread(bytes, 1, size, file) != size) host->surprises++;
    fclose(file);
    check(host, "deSerializeFMUstate", host->library.deserialise(host->instance, bytes, size, &state));
    check(host, "setFMUstate", host->library.set_state(host->instance, state));
    check(host, "freeFMUstate", host->library.free_state(host->instance, &state));
    free(bytes);
}

/* The part of a command behind so many colons, empty if there are not so many. */
static const char *argument(const char *command, int place)
{
    for (; place > 0; place--) {
        const char *colon = strchr(command, ':');
        if (!colon) return "";
        command = colon + 1;
    }
    return command;
}

/* Whether a command has that name. */
static int is(const char *command, const char *name)
{
    size_t length = strlen(name);
    return strncmp(command, name, length) == 0 && (command[length] == ':' || command[length] == '\0');
}

/* Set a Real or its rate. */
static void set(Host *host, int rate, const char *reference, const char *text)
{
    fmi2ValueReference vr = (fmi2ValueReference)strtoul(reference, NULL, 10);
    fmi2Real value = strtod(text, NULL);
    fmi2Integer order = 1;
    if (rate) {
        check(host, "setRealInputDerivatives", host->library.set_rate(host->instance, &vr, 1, &order, &value));
    } else {
        check(host, "setReal", host->library.set_real(host->instance, &vr, 1, &value));
    }
}

/* Carry out a command that changes the phase; 0 if it is none. */
static int change_phase(Host *host, const char *command)
{
    double number = strtod(argument(command, 1), NULL);
    const char *tolerance = argument(command, 2);
    fmi2Component c = host->instance;
    if (is(command, "start")) {
        start(host, number);
    } else if (is(command, "setup")) {
        host->time = number;
        check(host, "setupExperiment",
              host->library.setup(c, *tolerance != '\0', strtod(tolerance, NULL), number, fmi2False, 0.0));
    } else if (is(command, "enter")) {
        check(host, "enterInitializationMode", host->library.enter(c));
    } else if (is(command, "exit")) {
        check(host, "exitInitializationMode", host->library.exit(c));
    } else if (is(command, "terminate")) {
        check(host, "terminate", host->library.terminate(c));
    } else if (is(command, "reset")) {
        check(host, "reset", host->library.reset(c));
    } else {
        return 0;
    }
    return 1;
}

/* Carry out a command; 0 if it is not known. */
static int obey(Host *host, const char *command)
{
    const char *first = argument(command, 1), *second = argument(command, 2), *third = argument(command, 3);
    long count = strtol(second, NULL, 10);
    if (change_phase(host, command)) return 1;
    if (is(command, "set") || is(command, "rate")) {
        set(host, is(command, "rate"), first, second);
    } else if (is(command, "step")) {
        step(host, strtod(first, NULL), *second ? count : 1);
    } else if (is(command, "get")) {
        get(host, first);
    } else if (is(command, "save")) {
        save(host, first);
    } else if (is(command, "load")) {
        restore(host, first);
    } else if (is(command, "time")) {
        host->time = strtod(first, NULL);
    } else if (is(command, "float")) {
        return float_mode(host, first);
    } else if (is(command, "expect")) {
        host->expected = (fmi2Status)strtol(first, NULL, 10);
    } else if (is(command, "time-step")) {
        time_steps(host, strtod(first, NULL), count);
    } else if (is(command, "time-get")) {
        time_get(host, strtol(first, NULL, 10), second);
    } else if (is(command, "time-state")) {
        time_state(host, strtol(first, NULL, 10));
    } else if (is(command, "time-instantiate")) {
        time_instantiate(host, strtol(first, NULL, 10));
    } else if (is(command, "threads")) {
        time_threads(host, strtol(first, NULL, 10), strtod(second, NULL), strtol(third, NULL, 10));
    } else {
        return 0;
    }
    return 1;
}

/* Load, instantiate, obey, free. */
int main(int argc, char **argv)
{
    Host host;
    void *library;
    int i;
    memset(&host, 0, sizeof host);
    if (argc < 4) {
        fprintf(stderr, "usage: host LIBRARY GUID RESOURCES COMMAND...\n");
        return 2;
    }
    library = load(argv[1]);
    if (!library || !find_all(library, &host.library)) return 2;
    host.guid = argv[2];
    host.resources = argv[3];
    host.instance = instantiate(&host);
    if (!host.instance) return 2;
    for (i = 4; i < argc; i++) {
        if (!obey(&host, argv[i])) {
            fprintf(stderr, "unknown command %s\n", argv[i]);
            return 2;
        }
    }
    host.library.free_instance(host.instance);
    return host.surprises > 0;
}
