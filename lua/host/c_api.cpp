// SPDX-License-Identifier: MIT
// <lacuna.h> implemented with lacuna::Interpreter. No exception leaves this file.
#include <lacuna.h>

#include "bindings/unexpected.h"

#include <lacuna/interpreter.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct lacuna_interpreter {
    std::unique_ptr<lacuna::Interpreter> interpreter; ///< null: opening failed with the error below
    std::optional<lacuna::ScriptError> error{std::in_place, "", ""}; ///< the last error
    std::string text;                                                ///< text returned last
};

namespace {

using lacuna::ScriptError;

/// Store the error of a call. `error` of the handle is empty only if memory was exhausted.
void keep(lacuna_interpreter& handle, ScriptError error) noexcept
{
    try {
        handle.error.reset();
        handle.error.emplace(std::move(error));
    } catch (...) {
        handle.error.reset();
    }
}

ScriptError plain_error(const std::string& code, const std::string& message)
{
    ScriptError error(code, lacuna::formatted("{} [{}]", message, code));
    error.message = message;
    return error;
}

ScriptError plain_error(const lacuna::Error& of)
{
    ScriptError error = plain_error(of.code(), of.what());
    error.entities = of.message().entities();
    return error;
}

template <class Body>
lacuna_status guarded(lacuna_interpreter* handle, Body&& body) noexcept
{
    if (!handle) return LACUNA_FAILED;
    try {
        try {
            if (!handle->interpreter) return LACUNA_FAILED;
            body(*handle->interpreter);
            return LACUNA_OK;
        } catch (const ScriptError& error) {
            keep(*handle, error);
        } catch (const lacuna::Cancelled& error) {
            keep(*handle, plain_error(error));
            return LACUNA_CANCELLED;
        } catch (const lacuna::Error& error) {
            keep(*handle, plain_error(error));
        } catch (const std::bad_alloc&) {
            keep(*handle, plain_error("core.memory", "not enough memory"));
        } catch (const std::exception& error) {
            keep(*handle, plain_error("core.unexpected", lacuna::lua::unexpected_text(error.what())));
        }
    } catch (...) {
        handle->error.reset();
    }
    return LACUNA_FAILED;
}

template <class T>
lacuna_status get(lacuna_interpreter* handle, const char* path, T* value, const char* expected)
{
    return guarded(handle, [&](lacuna::Interpreter& interpreter) {
        const lacuna::Value found = interpreter.get(path);
        if (const T* there = std::get_if<T>(&found)) {
            *value = *there;
            return;
        }
        if constexpr (std::is_same_v<T, double>) {
            if (const auto* whole = std::get_if<std::int64_t>(&found)) {
                *value = static_cast<double>(*whole);
                return;
            }
        }
        throw plain_error("lua.no_value", lacuna::formatted("'{}' must be {}, found a {}", path, expected,
                                                            interpreter.type_of(path)));
    });
}

lacuna_status set(lacuna_interpreter* handle, const char* path, const lacuna::Value& value)
{
    return guarded(handle, [&](lacuna::Interpreter& interpreter) { interpreter.set(path, value); });
}

lacuna::InterpreterOptions options_of(const lacuna_options& asked)
{
    lacuna::InterpreterOptions options;
    void* const user = asked.user;
    if (asked.print)
        options.print = [user, call = asked.print](std::string_view t) { call(user, t.data(), t.size()); };
    if (asked.log)
        options.log = [user, call = asked.log](std::string_view t) { call(user, t.data(), t.size()); };
    if (asked.progress)
        options.progress = [user, call = asked.progress](std::string_view stage, double share) {
            return call(user, std::string(stage).c_str(), share) == 0;
        };
    if (asked.cancelled) options.cancelled = [user, call = asked.cancelled] { return call(user) != 0; };
    options.memory = asked.memory;
    options.instructions = asked.instructions;
    options.sandbox = asked.sandbox != 0;
    options.traceback = asked.traceback != 0;
    options.threads = asked.threads;
    if (asked.output_folder) options.output_folder = asked.output_folder;
    return options;
}

const char* const kNoMemory = "not enough memory"; // returned if there is no memory for an error object

/// Whether there is an error message.
bool failed(const lacuna_interpreter* interpreter) { return interpreter && interpreter->error; }

} // namespace

extern "C" {

const char* lacuna_version(void) { return LACUNA_VERSION; }

void lacuna_default_options(lacuna_options* options)
{
    *options = {};
    options->size = sizeof *options;
}

lacuna_interpreter* lacuna_open(const lacuna_options* options)
{
    lacuna_interpreter* handle = nullptr;
    try {
        handle = new lacuna_interpreter;
        lacuna_options known;
        lacuna_default_options(&known);
        if (options) std::memcpy(&known, options, std::min(options->size, sizeof known));
        handle->interpreter = std::make_unique<lacuna::Interpreter>(options_of(known));
    } catch (const lacuna::Error& error) {
        try {
            keep(*handle, plain_error(error));
        } catch (...) {
            handle->error.reset();
        }
    } catch (...) {
        delete handle;
        return nullptr;
    }
    return handle;
}

void lacuna_close(lacuna_interpreter* interpreter) { delete interpreter; }

lacuna_status lacuna_run_file(lacuna_interpreter* interpreter, const char* path, const char* const* words,
                              size_t count)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) {
        own.run_file(path, count == 0 ? std::vector<std::string>()
                                      : std::vector<std::string>(words, words + count));
    });
}

lacuna_status lacuna_run_string(lacuna_interpreter* interpreter, const char* text, size_t length,
                                const char* name)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) {
        own.run_string({text, length}, name ? name : "recipe");
    });
}

void lacuna_cancel(lacuna_interpreter* interpreter)
{
    if (interpreter && interpreter->interpreter) interpreter->interpreter->cancel();
}

const char* lacuna_error_text(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->what() : kNoMemory;
}

const char* lacuna_error_message(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->message.c_str() : kNoMemory;
}

const char* lacuna_error_code(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->code().c_str() : "core.memory";
}

const char* lacuna_error_file(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->file.c_str() : "";
}

int lacuna_error_line(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->line : 0;
}

const char* lacuna_error_traceback(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->traceback.c_str() : "";
}

size_t lacuna_error_entity_count(const lacuna_interpreter* interpreter)
{
    return failed(interpreter) ? interpreter->error->entities.size() : 0;
}

const char* lacuna_error_entity(const lacuna_interpreter* interpreter, size_t at, int64_t* tag)
{
    if (at >= lacuna_error_entity_count(interpreter)) return nullptr;
    const lacuna::NamedEntity& entity = interpreter->error->entities[at];
    if (tag) *tag = entity.tag;
    return entity.kind.c_str();
}

lacuna_status lacuna_set_nil(lacuna_interpreter* interpreter, const char* path)
{
    return set(interpreter, path, {});
}

lacuna_status lacuna_set_boolean(lacuna_interpreter* interpreter, const char* path, int value)
{
    return set(interpreter, path, value != 0);
}

lacuna_status lacuna_set_integer(lacuna_interpreter* interpreter, const char* path, int64_t value)
{
    return set(interpreter, path, value);
}

lacuna_status lacuna_set_number(lacuna_interpreter* interpreter, const char* path, double value)
{
    return set(interpreter, path, value);
}

lacuna_status lacuna_set_string(lacuna_interpreter* interpreter, const char* path, const char* text,
                                size_t length)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) { own.set(path, std::string(text, length)); });
}

lacuna_status lacuna_set_numbers(lacuna_interpreter* interpreter, const char* path, const double* numbers,
                                 size_t count)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) { own.set_numbers(path, numbers, count); });
}

lacuna_status lacuna_set_function(lacuna_interpreter* interpreter, const char* path, lacuna_function function,
                                  void* user)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) { own.set_function(path, function, user); });
}

lacuna_status lacuna_get_type(lacuna_interpreter* interpreter, const char* path, lacuna_type* type)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) {
        const std::string word = own.type_of(path);
        const lacuna::Value value = own.get(path);
        *type = word == "nil"                                ? LACUNA_NIL
                : word == "table"                            ? LACUNA_TABLE
                : word == "Buffer"                           ? LACUNA_BUFFER
                : std::holds_alternative<bool>(value)        ? LACUNA_BOOLEAN
                : std::holds_alternative<int64_t>(value)     ? LACUNA_INTEGER
                : std::holds_alternative<double>(value)      ? LACUNA_NUMBER
                : std::holds_alternative<std::string>(value) ? LACUNA_STRING
                                                             : LACUNA_OTHER;
    });
}

lacuna_status lacuna_get_boolean(lacuna_interpreter* interpreter, const char* path, int* value)
{
    bool found = false;
    const lacuna_status status = get<bool>(interpreter, path, &found, "true or false");
    if (status == LACUNA_OK) *value = found ? 1 : 0;
    return status;
}

lacuna_status lacuna_get_integer(lacuna_interpreter* interpreter, const char* path, int64_t* value)
{
    return get<std::int64_t>(interpreter, path, value, "a whole number");
}

lacuna_status lacuna_get_number(lacuna_interpreter* interpreter, const char* path, double* value)
{
    return get<double>(interpreter, path, value, "a number");
}

lacuna_status lacuna_get_string(lacuna_interpreter* interpreter, const char* path, const char** text,
                                size_t* length)
{
    if (!interpreter) return LACUNA_FAILED;
    const lacuna_status status = get<std::string>(interpreter, path, &interpreter->text, "a string");
    if (status != LACUNA_OK) return status;
    *text = interpreter->text.c_str();
    if (length) *length = interpreter->text.size();
    return status;
}

lacuna_status lacuna_get_buffer(lacuna_interpreter* interpreter, const char* path, lacuna_buffer* buffer)
{
    return guarded(interpreter, [&](lacuna::Interpreter& own) {
        const lacuna::BufferView view = own.buffer(path);
        *buffer = {view.data, view.rows, view.columns,
                   view.type == lacuna::BufferView::Type::float64 ? 0 : 1};
    });
}

} // extern "C"
