/* What is said to the master, filtered by the categories it asked for. */
#ifndef FB_LOG_H
#define FB_LOG_H

#include "model.h"

#include "fmi2FunctionTypes.h"
#include "fmi2TypesPlatform.h"

typedef struct Log {
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    const char *name;   /* of the instance */
    const Model *model; /* its categories; NULL while there is none: then all is said */
    uint32_t enabled;   /* bit k: category k */
} Log;

/* Say something about a call with that status, if its category is asked for. */
void log_say(const Log *log, fmi2Status status, const Text *text);

/* Ask for all categories, for some, or for none; 0 with the reason where one is unknown. */
int log_enable(Log *log, int on, size_t count, const fmi2String *names, Text *why);

#endif
