/* From the resource location a master gives to an open file. */
#ifndef FB_PATH_H
#define FB_PATH_H

#include "text.h"

#include <stdio.h>

/* Open a file of the resources for reading; NULL with the reason. `path` gets what was opened last. */
FILE *path_open(const char *location, const char *name, Text *path, Text *why);

#endif
