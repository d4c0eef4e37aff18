#include "path.h"

#include <string.h>

#ifdef _WIN32
#include <stdlib.h>
#include <windows.h>
enum { ON_WINDOWS = 1 };
#else
enum { ON_WINDOWS = 0 };
#endif

/* Value of a hexadecimal digit, -1 if it is none. */
static int hex(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/* Whether a text begins with a letter and a colon, as a Windows drive. */
static int is_drive(const char *text)
{
    return ((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z')) && text[1] == ':';
}

/* Whether a text begins with "file:" in any case. */
static int is_file_uri(const char *text)
{
    const char *scheme = "file:";
    int i;
    for (i = 0; scheme[i]; i++) {
        if ((text[i] | 0x20) != scheme[i] && text[i] != scheme[i]) return 0;
    }
    return 1;
}

/* Whether a text begins with a scheme and two slashes, such as "http://". */
static int has_scheme(const char *text)
{
    size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+.-");
    return length > 1 && strncmp(text + length, "://", 3) == 0;
}

/* Append the path of a URI, with or without turning %XX into bytes; 0 if it holds a zero byte. */
static int add_path(Text *path, const char *uri, int decode)
{
    for (; *uri; uri++) {
        int high = decode && *uri == '%' ? hex(uri[1]) : -1;
        int low = high >= 0 ? hex(uri[2]) : -1;
        char byte = *uri;
        if (low >= 0) { /* a stray % stays what it is */
            byte = (char)(16 * high + low);
            uri += 2;
        }
        if (!byte) return 0;
        text_add_bytes(path, &byte, 1);
    }
    return 1;
}

/* Whether a character separates folders on Windows. */
static int is_separator(char c)
{
    return c == '/' || c == '\\';
}

/* The path that begins in a file URI behind "file:"; a prefix it needs goes into `path`. */
static const char *strip_host(const char *rest, Text *path)
{
    if (strncmp(rest, "//", 2) == 0) {
        rest += 2;
        if (strncmp(rest, "localhost/", 10) == 0) {
            rest += 9;
        } else if (rest[0] != '/' && !is_drive(rest)) {
            text_add(path, ON_WINDOWS ? "//" : "/", NULL); /* a server, or a slash forgotten */
        }
    }
    return ON_WINDOWS && is_separator(rest[0]) && is_drive(rest + 1) ? rest + 1 : rest;
}

/* Length of the beginning of an extended path of Windows, \\?\ or \\.\ with slashes of either kind, 0 if a path is
 * none. Behind "file:" there may be more slashes than two before the question mark. */
static size_t extended_prefix(const char *path)
{
    size_t slashes = 0;
    while (is_separator(path[slashes])) slashes++;
    if (slashes < 2 || (path[slashes] != '?' && path[slashes] != '.')) return 0;
    return is_separator(path[slashes + 1]) ? slashes + 2 : 0;
}

/* Write an extended path as Windows wants it: it takes such paths literally, slashes too. */
static void straighten(Text *path)
{
    size_t prefix = ON_WINDOWS && path->data ? extended_prefix(path->data) : 0;
    char kind[] = "\\\\?\\";
    Text straight = {0};
    size_t i;
    if (!prefix) return;
    kind[2] = path->data[prefix - 2];
    text_add(&straight, kind, path->data + prefix, NULL);
    for (i = 0; i < straight.length; i++) {
        if (straight.data[i] == '/') straight.data[i] = '\\';
    }
    text_free(path);
    *path = straight;
}

/* Path of a file in the resources; 0 if the location holds a zero byte. */
static int resolve(const char *location, const char *name, int decode, Text *path)
{
    int uri = is_file_uri(location);
    const char *rest = uri ? strip_host(location + 5, path) : location;
    if (!add_path(path, rest, uri && decode)) return 0;
    if (path->length) {
        char last = path->data[path->length - 1];
        if (last != '/' && !(ON_WINDOWS && last == '\\')) text_add(path, "/", NULL);
    }
    text_add(path, name, NULL);
    straighten(path);
    return 1;
}

#ifdef _WIN32
/* Open a file whose name is in a code page. */
static FILE *open_in(const char *path, UINT page)
{
    DWORD strict = page == CP_UTF8 ? MB_ERR_INVALID_CHARS : 0;
    int size = MultiByteToWideChar(page, strict, path, -1, NULL, 0);
    wchar_t *wide = size > 0 ? calloc((size_t)size, sizeof *wide) : NULL;
    FILE *file = NULL;
    if (wide && MultiByteToWideChar(page, strict, path, -1, wide, size)) file = _wfopen(wide, L"rb");
    free(wide);
    return file;
}

/* Open a file whose name is UTF-8, as FMI has it, or in the code page of the system, as some hosts pass it. */
static FILE *open_file(const char *path)
{
    FILE *file = open_in(path, CP_UTF8);
    return file ? file : open_in(path, CP_ACP);
}
#else
/* Open a file whose name is UTF-8. */
static FILE *open_file(const char *path)
{
    return fopen(path, "rb");
}
#endif

/* Open a file of the resources; a location that was not encoded is tried unchanged as well. */
FILE *path_open(const char *location, const char *name, Text *path, Text *why)
{
    int decode;
    if (!location || !*location) {
        text_add(why, "the host gave no resource location", NULL);
        return NULL;
    }
    if (!is_file_uri(location) && has_scheme(location)) {
        text_add(why, "the resource location ", location, " is neither a file: URI nor a path", NULL);
        return NULL;
    }
    for (decode = 1; decode >= 0; decode--) {
        FILE *file;
        text_free(path);
        if (!resolve(location, name, decode, path)) continue;
        file = path->failed ? NULL : open_file(text_string(path));
        if (file) return file;
    }
    text_add(why, "cannot open ", text_string(path), " (resource location ", location, ")", NULL);
    return NULL;
}
