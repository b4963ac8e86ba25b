// SPDX-License-Identifier: MIT
#pragma once

// Recipes inside a C++ host: the library `lacuna::interpreter` of the installed package. It needs no header
// of Lua, and of the kernel's only those of its errors. <lacuna.h> is the same for C and other languages.

#include <lacuna/core/error.h>
#include <lacuna/core/named_entities.h>

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

struct Crew; // <lacuna/core/team.h>, of the kernel's headers

/// A plain value of a recipe; std::monostate is nil, and stands for whatever is no plain value.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct InterpreterOptions {
    // Callbacks come on the thread that runs the recipe. What they throw stops the run, which throws it on.
    std::function<void(std::string_view text)> print; ///< what print() writes, line ends and all; empty:
                                                      ///< to standard output
    std::function<void(std::string_view line)> log;   ///< notes of the kernel
    std::function<bool(std::string_view, double)> progress; ///< stage, share in [0, 1]; false stops the run
    std::function<void()> ended;     ///< the stage told last is over; the recipe goes on
    std::function<bool()> cancelled; ///< asked every 10,000 instructions and before `progress`; true stops

    /// Most that Lua's own values may take, 0: no limit [bytes]. Meshes and models are not among them.
    std::size_t memory = 0;
    std::uint64_t instructions = 0; ///< most steps of Lua a run may take, to 10,000; 0: no limit
    bool sandbox = false;           ///< no os, io, debug, package or bytecode; files only as follows
    std::string output_folder;      ///< with `sandbox`: files are written below it alone; empty: nowhere
    int threads = 0;                ///< most that a sweep takes which asks for none itself; 0: all cores
    const Crew* crew = nullptr;     ///< processes that help with layers that are written; null: none
    bool traceback = false;         ///< ScriptError::traceback is filled in
};

/// A recipe failed. `what()` is the sentence for a person, with file, line and code.
class __attribute__((visibility("default"))) ScriptError : public Error {
public:
    ScriptError(std::string code, const std::string& text) : Error(std::move(code), text) {}

    std::string message;               ///< what went wrong, without file, line and code
    std::string file;                  ///< of the recipe; empty: not known
    int line = 0;                      ///< 0: not known
    std::vector<NamedEntity> entities; ///< that the message names
    std::string traceback;
};

/// Numbers of a recipe as they lie in memory: what `mesh:coordinates()` and `mesh:cells()` return.
struct BufferView {
    enum class Type { float64, int32 };
    Type type = Type::float64;
    const void* data = nullptr; ///< rows × columns numbers, row after row
    std::size_t rows = 0, columns = 0;
};

/// A Lua of its own with `lacuna` ready to be required.
///
/// Any number may be open at once, each used by one thread at a time. The host's locale, streams and signal
/// handlers are not touched; numbers are read and written with a decimal point whatever the locale. CAD files
/// are read by a process that all interpreters share (<lacuna/cad/load.h>).
///
/// Paths name values: globals and their fields, as `mesh`, `mesh.hexes`, `list.1` or `job.faces.2.area`.
class __attribute__((visibility("default"))) Interpreter {
public:
    /// @throw InvalidInput  the output folder is none; std::bad_alloc
    explicit Interpreter(InterpreterOptions options = {});
    ~Interpreter();
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;

    /// Run a recipe, "-" for standard input, with `key=value` words for `lacuna.params`.
    /// @return  the first value it returns.
    /// @throw ScriptError; Cancelled; what a callback throws.
    Value run_file(const std::string& path, const std::vector<std::string>& words = {});
    /// Run the text of a recipe; `name` stands in messages where a file's name would.
    Value run_string(std::string_view text, const std::string& name = "recipe");

    /// Whether the recipe of the last run_file() asked for its words.
    bool words_used();

    /// Stop the run there is, or the next one: it throws Cancelled. From any thread and from signal handlers.
    void cancel() noexcept;
    /// Forget a cancel() that no run has met.
    void resume() noexcept;

    /// @throw ScriptError  the path leads through something without fields, or nowhere (get_…, buffer).
    void set(const std::string& path, const Value& value);
    void set_numbers(const std::string& path, const double* numbers, std::size_t count); ///< as an array
    Value get(const std::string& path);
    /// Lua's word for what is there: "nil", "number", "table"… or a class of Lacuna's: "Mesh", "Buffer".
    std::string type_of(const std::string& path);
    /// An array of numbers, or a buffer's as one row after the other.
    std::vector<double> get_numbers(const std::string& path);
    /// A buffer in place. @pre it stays in a variable of the recipe as long as the view is used.
    BufferView buffer(const std::string& path);

    // For hosts that know Lua's C API and link the same Lua.

    [[nodiscard]] lua_State* state() const noexcept;
    /// Call the function under `arguments` values on top of the stack, as a run. Pops them all.
    Value call(int arguments);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna
