// SPDX-License-Identifier: MIT
#pragma once

// Runs recipes inside a C++ host: the library `lacuna::interpreter` of the installed package. It needs no Lua
// headers, and of the kernel only those of its errors. <lacuna.h> is the same for C and other languages.

#include <lacuna/core/error.h>
#include <lacuna/core/message.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

struct lua_State;

namespace lacuna {

struct Crew; // <lacuna/core/shared/team.h>, of the kernel's headers

/// A plain value of a recipe. std::monostate is nil, or a value that is not plain, such as a table.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct InterpreterOptions {
    // Callbacks are called on the thread that runs the recipe. An exception stops the run, which rethrows it.
    std::function<void(std::string_view text)> print;       ///< output of print(), line ends included; empty:
                                                            ///< standard output
    std::function<void(std::string_view line)> log;         ///< receives notes of the kernel
    std::function<bool(std::string_view, double)> progress; ///< stage, share of the call; false: stop
    std::function<void()> ended;     ///< the last stage has ended; the recipe continues
    std::function<bool()> cancelled; ///< called every 10,000 instructions and before `progress`; true: stop

    /// Limit on the memory of Lua's own values, 0: none [bytes]. Meshes and models do not count.
    std::size_t memory = 0;
    std::uint64_t instructions = 0; ///< limit on the Lua instructions of a run, in steps of 10,000; 0: none
    bool sandbox = false;           ///< no os, io, debug, package or bytecode; files only as below
    std::string output_folder;      ///< with `sandbox`: the only folder for output files; empty: none
    int threads = 0;                ///< default number of threads of a sweep; 0: all cores
    const Crew* crew = nullptr;     ///< processes that help to write layers; null: none
    bool traceback = false;         ///< fill ScriptError::traceback
};

/// A recipe failed. `what()` is the message for a person, with file, line and code.
class __attribute__((visibility("default"))) ScriptError : public Error {
public:
    ScriptError(std::string_view code, std::string_view text) : Error(code, "{}", text) {}

    std::string message;               ///< the message, without file, line and code
    std::string file;                  ///< the recipe; empty: unknown
    int line = 0;                      ///< 0: unknown
    std::vector<NamedEntity> entities; ///< entities named in the message
    std::string traceback;
};

/// A function of the host that recipes call with `count` numbers. It sets at most `room` results and returns
/// their number; below 0: it failed, an error of the recipe. An exception stops the run, which rethrows it.
using HostFunction = int (*)(void* user, const double* arguments, std::size_t count, double* results,
                             std::size_t room);

/// A view of numbers of a recipe, as returned by `mesh:coordinates()` and `mesh:cells()`.
struct BufferView {
    enum class Type { float64, int32 };
    Type type = Type::float64;
    const void* data = nullptr; ///< rows × columns numbers, row by row
    std::size_t rows = 0, columns = 0;
};

/// A Lua interpreter in which recipes can require `lacuna`.
///
/// Several may exist at once; each is used by one thread at a time. The locale, streams and signal handlers
/// of the host are not changed; numbers always have a decimal point. CAD files are read by a process that all
/// interpreters share (<lacuna/cad/load.h>).
///
/// Values are named by paths: a global and its fields, such as `mesh`, `mesh.hexes`,
/// `list.1` or `job.faces.2.area`.
class __attribute__((visibility("default"))) Interpreter {
public:
    /// @throw InvalidInput  the output folder does not exist; std::bad_alloc
    explicit Interpreter(InterpreterOptions options = {});
    ~Interpreter();
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;

    /// Run a recipe, "-" for standard input, with `key=value` words that `lacuna.params` reads.
    /// @return  the first value it returns.
    /// @throw ScriptError; Cancelled; what a callback throws.
    Value run_file(const std::string& path, const std::vector<std::string>& words = {});
    /// Run a recipe given as text; `name` replaces the file name in messages.
    Value run_string(std::string_view text, const std::string& name = "recipe");

    /// Whether the recipe of the last run_file() read its words.
    bool words_used();

    /// Stop the current run, or the next one: it throws Cancelled. Callable from any
    /// thread and from signal handlers.
    void cancel() noexcept;
    /// Discard a cancel() that no run has noticed.
    void resume() noexcept;

    /// @throw ScriptError  the path leads through a value without fields, or (get_…, buffer) to no value.
    void set(const std::string& path, const Value& value);
    void set_numbers(const std::string& path, const double* numbers, std::size_t count); ///< as an array
    void set_function(const std::string& path, HostFunction function, void* user);
    Value get(const std::string& path);
    /// The type of a value: "nil", "number", "table"… or a class of Lacuna: "Mesh", "Buffer".
    std::string type_of(const std::string& path);
    /// The numbers of an array, or of a buffer row by row.
    std::vector<double> get_numbers(const std::string& path);
    /// View a buffer without copying. @pre a variable of the recipe holds the buffer while the view is used.
    BufferView buffer(const std::string& path);

    // For hosts that use Lua's C API and link the same Lua library.

    [[nodiscard]] lua_State* state() const noexcept;
    /// Call the function below `arguments` values on top of the stack, as a run. Pops them all.
    Value call(int arguments);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna
