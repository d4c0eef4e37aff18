#include "fuzz.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const NAMES[] = {"one", "", "a name with %s %n %d in it"};

/* Leave the program because of what the library did. */
void give_up(const Fuzz *fuzz, const char *call, const char *what)
{
    long calls = fuzz->answers[0] + fuzz->answers[1] + fuzz->answers[2] + fuzz->answers[3];
    printf("after %ld calls: %s %s\n", calls, call, what);
    exit(1);
}

/* Note the answer to a call. */
fmi2Status answer(Fuzz *fuzz, const char *call, fmi2Status status)
{
    if ((int)status < fmi2OK || status > fmi2Error) give_up(fuzz, call, "answered neither OK nor a refusal");
    fuzz->answers[status]++;
    return status;
}

/* Read a message to its end, with its arguments filled in. */
static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    Fuzz *fuzz = environment;
    char text[256];
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    if (!name || !category || (int)status < fmi2OK || status > fmi2Error) {
        give_up(fuzz, "the logger", "was called with wrong arguments");
    }
    if (strlen(message) == 0) give_up(fuzz, category, "has a message without words");
    fuzz->logged++;
}

/* The resource location: right, or not. */
static const char *location_of(Fuzz *fuzz, const char *folder, int strange, char *place)
{
    size_t i, length;
    if (!strange || chance(fuzz, 60)) return folder;
    if (chance(fuzz, 20)) return NULL;
    length = (size_t)below(fuzz, 200);
    for (i = 0; i < length; i++) {
        place[i] = chance(fuzz, 30) ? "%:/.fF0a"[below(fuzz, 8)] : (char)(1 + below(fuzz, 255));
    }
    place[length] = '\0';
    if (length > 8 && chance(fuzz, 60)) memcpy(place, "file://", 7);
    return place;
}

/* Make an instance. */
fmi2Component make(Fuzz *fuzz, const char *folder, int strange)
{
    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    /* FMI wants the callbacks to outlive the instance; the library is not to rely on it after the call */
    fmi2CallbackFunctions *given = malloc(sizeof *given);
    fmi2String name = strange && chance(fuzz, 10) ? NULL : NAMES[below(fuzz, 3)];
    fmi2String guid = fuzz->guid;
    fmi2Type type = fmi2CoSimulation;
    char place[201];
    fmi2Component made;
    /* one after the other, as C leaves the order of arguments open */
    fmi2Boolean visible = chance(fuzz, 50), logging = chance(fuzz, 70);
    callbacks.componentEnvironment = fuzz;
    if (strange && chance(fuzz, 10)) callbacks.logger = NULL;
    if (strange && chance(fuzz, 10)) guid = chance(fuzz, 50) ? NULL : "%s%n another one";
    if (strange && chance(fuzz, 10)) type = (fmi2Type)below(fuzz, 3);
    memcpy(given, &callbacks, sizeof callbacks);
    folder = location_of(fuzz, folder, strange, place);
    made = fmi2Instantiate(name, type, guid, folder, strange && chance(fuzz, 5) ? NULL : given, visible, logging);
    free(given);
    return made;
}

/* Give the states kept aside and the instance back. */
void drop(Fuzz *fuzz, Slave *slave)
{
    int i;
    for (i = 0; i < MOST_STATES; i++) {
        if (answer(fuzz, "freeFMUstate", fmi2FreeFMUstate(slave->instance, &slave->states[i])) != fmi2OK) {
            give_up(fuzz, "freeFMUstate", "refused to free a state");
        }
    }
    fmi2FreeInstance(slave->instance);
    slave->instance = NULL;
}
