/* SPDX-License-Identifier: MIT */
/* Recipes inside a host of any language: C, and whatever can call C.
 *
 * Nothing is thrown: calls return a status, and the last failure of an interpreter is kept in it.
 *
 * Ownership. lacuna_open() gives a handle, which lacuna_close() ends. Every text that is returned belongs to
 * the handle and lasts until the next call with it. What is handed over is copied. A buffer belongs to the
 * recipe and lasts as long as a variable of the recipe holds it.
 *
 * Threads. Any number of handles may be open at once, each used by one thread at a time; lacuna_cancel() may
 * be called from any thread and from signal handlers. Callbacks come on the thread that runs the recipe. They
 * may call lacuna_cancel() and nothing else with their handle.
 *
 * Paths name values: globals and their fields, as "mesh", "mesh.hexes", "list.1", "job.faces.2.area".
 */
#ifndef LACUNA_H
#define LACUNA_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LACUNA_API __attribute__((visibility("default")))

typedef struct lacuna_interpreter lacuna_interpreter;
struct lua_State;

typedef enum lacuna_status {
    LACUNA_OK = 0,
    LACUNA_FAILED = 1,   /* lacuna_error_message() and the rest say why */
    LACUNA_CANCELLED = 2 /* the host asked for it */
} lacuna_status;

typedef enum lacuna_type {
    LACUNA_NIL = 0,
    LACUNA_BOOLEAN = 1,
    LACUNA_INTEGER = 2,
    LACUNA_NUMBER = 3,
    LACUNA_STRING = 4,
    LACUNA_TABLE = 5,
    LACUNA_BUFFER = 6,
    LACUNA_OTHER = 7 /* a Model, Volume, Mesh, a function… */
} lacuna_type;

/* Fill it in with lacuna_default_options(), then change what is to be otherwise. */
typedef struct lacuna_options {
    size_t size; /* of this struct, so that later versions may add to it */
    void* user;  /* handed to every callback; all of them may be null */
    void (*print)(void* user, const char* text, size_t length);   /* null: to standard output */
    void (*log)(void* user, const char* text, size_t length);     /* a note of the kernel */
    int (*progress)(void* user, const char* stage, double share); /* share in [0, 1]; not 0 stops the run */
    int (*cancelled)(void* user);                                 /* asked often; not 0 stops the run */
    size_t memory;             /* most that Lua's own values may take [bytes]; 0: no limit */
    uint64_t instructions;     /* most steps of Lua a run may take, to 10,000; 0: no limit */
    const char* output_folder; /* with sandbox: files are written below it alone; null: nowhere */
    int sandbox;               /* not 0: no os, io, debug, package or bytecode */
    int traceback;             /* not 0: lacuna_error_traceback() has one */
    int threads;               /* most that a sweep takes which asks for none itself; 0: all cores */
} lacuna_options;

typedef struct lacuna_buffer {
    const void* data; /* rows × columns numbers, row after row */
    size_t rows, columns;
    int type; /* 0: double, 1: int32_t */
} lacuna_buffer;

LACUNA_API const char* lacuna_version(void);
LACUNA_API void lacuna_default_options(lacuna_options* options);

/* A handle, null only where there is no memory. `options` may be null. Where opening failed otherwise, as for
 * an output folder that is none, lacuna_error_message() says why, and every run fails in the same way. */
LACUNA_API lacuna_interpreter* lacuna_open(const lacuna_options* options);
LACUNA_API void lacuna_close(lacuna_interpreter* interpreter); /* null: nothing happens */

/* `words` are the key=value words for lacuna.params; null where `count` is 0. */
LACUNA_API lacuna_status lacuna_run_file(lacuna_interpreter* interpreter, const char* path,
                                         const char* const* words, size_t count);
/* `name` stands in messages where a file's name would; null: "recipe". */
LACUNA_API lacuna_status lacuna_run_string(lacuna_interpreter* interpreter, const char* text, size_t length,
                                           const char* name);
/* Stop the run there is, or the next one. */
LACUNA_API void lacuna_cancel(lacuna_interpreter* interpreter);

/* The last failure; "" and 0 where there is none. */
LACUNA_API const char* lacuna_error_text(
    const lacuna_interpreter* interpreter); /* file, line, message, code */
LACUNA_API const char* lacuna_error_message(const lacuna_interpreter* interpreter); /* the message alone */
LACUNA_API const char* lacuna_error_code(const lacuna_interpreter* interpreter);
LACUNA_API const char* lacuna_error_file(const lacuna_interpreter* interpreter);
LACUNA_API int lacuna_error_line(const lacuna_interpreter* interpreter);
LACUNA_API const char* lacuna_error_traceback(const lacuna_interpreter* interpreter);
LACUNA_API size_t lacuna_error_entity_count(const lacuna_interpreter* interpreter);
/* The entity numbered `at` from 0; null where there is none. */
LACUNA_API const char* lacuna_error_entity(const lacuna_interpreter* interpreter, size_t at, int64_t* tag);

LACUNA_API lacuna_status lacuna_set_nil(lacuna_interpreter* interpreter, const char* path);
LACUNA_API lacuna_status lacuna_set_boolean(lacuna_interpreter* interpreter, const char* path, int value);
LACUNA_API lacuna_status lacuna_set_integer(lacuna_interpreter* interpreter, const char* path, int64_t value);
LACUNA_API lacuna_status lacuna_set_number(lacuna_interpreter* interpreter, const char* path, double value);
LACUNA_API lacuna_status lacuna_set_string(lacuna_interpreter* interpreter, const char* path,
                                           const char* text, size_t length);
LACUNA_API lacuna_status lacuna_set_numbers(lacuna_interpreter* interpreter, const char* path,
                                            const double* numbers, size_t count);

/* Each fails where the value is of another kind; an integer is a number too. */
LACUNA_API lacuna_status lacuna_get_type(lacuna_interpreter* interpreter, const char* path,
                                         lacuna_type* type);
LACUNA_API lacuna_status lacuna_get_boolean(lacuna_interpreter* interpreter, const char* path, int* value);
LACUNA_API lacuna_status lacuna_get_integer(lacuna_interpreter* interpreter, const char* path,
                                            int64_t* value);
LACUNA_API lacuna_status lacuna_get_number(lacuna_interpreter* interpreter, const char* path, double* value);
LACUNA_API lacuna_status lacuna_get_string(lacuna_interpreter* interpreter, const char* path,
                                           const char** text, size_t* length);
LACUNA_API lacuna_status lacuna_get_buffer(lacuna_interpreter* interpreter, const char* path,
                                           lacuna_buffer* buffer);

/* For a host that owns a lua_State: luaL_requiref(L, "lacuna", luaopen_lacuna, 0). It must be of the Lua that
 * this library is linked with, version 5.4. */
LACUNA_API int luaopen_lacuna(struct lua_State* L);

#ifdef __cplusplus
}
#endif

#endif
