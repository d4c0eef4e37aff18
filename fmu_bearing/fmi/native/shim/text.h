/* Messages of any length, and numbers written the way Python writes them. */
#ifndef FB_TEXT_H
#define FB_TEXT_H

#include <stddef.h>

/* A text that grows; all zero is the empty one. */
typedef struct Text {
    char *data;
    size_t length, capacity;
    int failed; /* memory ran out: the text is not complete */
} Text;

/* Append strings up to a NULL; a NULL at the first place appends nothing. */
void text_add(Text *text, const char *first, ...);

/* Append some bytes. */
void text_add_bytes(Text *text, const char *bytes, size_t count);

/* Append a number: the shortest text that reads back as the same double (0), or so many digits as %g. */
void text_add_number(Text *text, double value, int digits);

/* Append a number with so many decimals, as %.1f does. */
void text_add_fixed(Text *text, double value, int decimals);

/* Append a whole number. */
void text_add_whole(Text *text, unsigned long long value);

/* The text as a string, never NULL; valid until the text changes. */
const char *text_string(const Text *text);

/* Give the memory back; the text is then empty. */
void text_free(Text *text);

#endif
