/* SPDX-License-Identifier: MIT */
/* Runs recipes inside a host in C, or in a language that can call C.
 *
 * No exceptions: calls return a status, and the handle stores the last failure.
 *
 * Ownership. lacuna_open() creates a handle, lacuna_close() destroys it. A returned text belongs to the
 * handle and is valid until the next call with it. Arguments are copied. A buffer belongs to the recipe and
 * is valid as long as a variable of the recipe holds it.
 *
 * Threads. Several handles may be open at once, each used by one thread at a time; lacuna_cancel() may be
 * called from any thread and from signal handlers. Callbacks are called on the thread that runs the recipe.
 * The only function that they may call with their handle is lacuna_cancel().
 *
 * Values are named by paths: a global and its fields, such as "mesh", "mesh.hexes", "list.1",
 * "job.faces.2.area".
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
    LACUNA_FAILED = 1,   /* see lacuna_error_message() and the others */
    LACUNA_CANCELLED = 2 /* requested by the host */
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

/* Initialise it with lacuna_default_options(), then change members. */
typedef struct lacuna_options {
    size_t size; /* of this struct, so that later versions may add to it */
    void* user;  /* passed to every callback; callbacks may be null */
    void (*print)(void* user, const char* text, size_t length);   /* null: prints to standard output */
    void (*log)(void* user, const char* text, size_t length);     /* receives notes of the kernel */
    int (*progress)(void* user, const char* stage, double share); /* of the call, in [0, 1]; not 0: stop */
    int (*cancelled)(void* user);                                 /* called often; not 0: stop the run */
    size_t memory;             /* limit on the memory of Lua's own values [bytes]; 0: none */
    uint64_t instructions;     /* limit on the Lua instructions of a run, in steps of 10,000; 0: none */
    const char* output_folder; /* with sandbox: the only folder for output files; null: none */
    int sandbox;               /* not 0: no os, io, debug, package or bytecode */
    int traceback;             /* not 0: lacuna_error_traceback() returns one */
    int threads;               /* default number of threads of a sweep; 0: all cores */
} lacuna_options;

/* A function of the host that recipes call with `count` numbers, 16 at most: a size function, for example.
 * It sets at most `room` results and returns their number; below 0: it failed, an error of the recipe. */
typedef int (*lacuna_function)(void* user, const double* arguments, size_t count, double* results,
                               size_t room);

typedef struct lacuna_buffer {
    const void* data; /* rows × columns numbers, row by row */
    size_t rows, columns;
    int type; /* 0: double, 1: int32_t */
} lacuna_buffer;

LACUNA_API const char* lacuna_version(void);
LACUNA_API void lacuna_default_options(lacuna_options* options);

/* Create a handle; null only if memory is exhausted. `options` may be null. If opening fails for another
 * reason, such as a missing output folder, lacuna_error_message() gives it, and every run fails with it. */
LACUNA_API lacuna_interpreter* lacuna_open(const lacuna_options* options);
LACUNA_API void lacuna_close(lacuna_interpreter* interpreter); /* may be null */

/* `words` are the key=value words for lacuna.params; null where `count` is 0. */
LACUNA_API lacuna_status lacuna_run_file(lacuna_interpreter* interpreter, const char* path,
                                         const char* const* words, size_t count);
/* `name` replaces the file name in messages; null: "recipe". */
LACUNA_API lacuna_status lacuna_run_string(lacuna_interpreter* interpreter, const char* text, size_t length,
                                           const char* name);
/* Stop the current run, or the next one. */
LACUNA_API void lacuna_cancel(lacuna_interpreter* interpreter);

/* The last failure; "" and 0 if there is none. */
LACUNA_API const char* lacuna_error_text(
    const lacuna_interpreter* interpreter); /* file, line, message, code */
LACUNA_API const char* lacuna_error_message(const lacuna_interpreter* interpreter); /* message only */
LACUNA_API const char* lacuna_error_code(const lacuna_interpreter* interpreter);
LACUNA_API const char* lacuna_error_file(const lacuna_interpreter* interpreter);
LACUNA_API int lacuna_error_line(const lacuna_interpreter* interpreter);
LACUNA_API const char* lacuna_error_traceback(const lacuna_interpreter* interpreter);
LACUNA_API size_t lacuna_error_entity_count(const lacuna_interpreter* interpreter);
/* The entity with index `at`, from 0; null if there is none. */
LACUNA_API const char* lacuna_error_entity(const lacuna_interpreter* interpreter, size_t at, int64_t* tag);

LACUNA_API lacuna_status lacuna_set_nil(lacuna_interpreter* interpreter, const char* path);
LACUNA_API lacuna_status lacuna_set_boolean(lacuna_interpreter* interpreter, const char* path, int value);
LACUNA_API lacuna_status lacuna_set_integer(lacuna_interpreter* interpreter, const char* path, int64_t value);
LACUNA_API lacuna_status lacuna_set_number(lacuna_interpreter* interpreter, const char* path, double value);
LACUNA_API lacuna_status lacuna_set_string(lacuna_interpreter* interpreter, const char* path,
                                           const char* text, size_t length);
LACUNA_API lacuna_status lacuna_set_numbers(lacuna_interpreter* interpreter, const char* path,
                                            const double* numbers, size_t count);
/* The function is called on the thread that runs the recipe. */
LACUNA_API lacuna_status lacuna_set_function(lacuna_interpreter* interpreter, const char* path,
                                             lacuna_function function, void* user);

/* Fail if the value has another type; an integer is a number too. */
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

/* For a host that owns a lua_State: luaL_requiref(L, "lacuna", luaopen_lacuna, 0). It must belong to the
 * Lua library, version 5.4, that this library is linked with. */
LACUNA_API int luaopen_lacuna(struct lua_State* L);

#ifdef __cplusplus
}
#endif

#endif
