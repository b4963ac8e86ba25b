// SPDX-License-Identifier: MIT
// Lua raises errors by longjmp and C++ by exceptions; neither may pass through frames of the other. So code
// that may raise a Lua error runs in a protected call and owns no objects with destructors. Its results are
// left on Lua's stack, from where C++ takes them with calls that do not raise.
#include "host/interpreter_state.h"

#include "bindings/box.h"
#include "bindings/push.h"
#include "host/sandbox.h"

#include <charconv>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

namespace lacuna {

namespace {

constexpr int kHookInstructions = 10'000; // often enough to react at once, seldom enough to cost no time

/// Sets the C locale for numbers in this thread, and restores the host's locale in the destructor.
class PlainNumbers {
public:
    PlainNumbers() : before_(uselocale(plain())) {}
    ~PlainNumbers() { uselocale(before_); }
    PlainNumbers(const PlainNumbers&) = delete;
    PlainNumbers& operator=(const PlainNumbers&) = delete;

private:
    static locale_t plain()
    {
        static const locale_t kPlain = newlocale(LC_NUMERIC_MASK, "C", duplocale(uselocale(nullptr)));
        return kPlain;
    }
    locale_t before_;
};

// --- inside protected calls -----------------------------------------------------------------------------

/// Push text, message, code, file, line and entities of the error at index 1; nil if unknown.
int read_error(lua_State* L)
{
    lua_settop(L, 1);
    if (lua_isstring(L, 1) || luaL_getmetafield(L, 1, "__tostring") != LUA_TNIL) {
        lua_settop(L, 1);
        luaL_tolstring(L, 1, nullptr);
    } else {
        lua_pushfstring(L, "(error object is a %s value)", luaL_typename(L, 1));
    }
    for (const char* field : {"message", "code", "file", "line", "entities"}) {
        lua_pushstring(L, field);
        if (lua_istable(L, 1))
            lua_rawget(L, 1);
        else
            lua_pop(L, 1), lua_pushnil(L);
    }
    return 6;
}

/// The entities in the `entities` field of an error. Raises no Lua error: it allocates nothing in Lua.
std::vector<NamedEntity> entities_at(lua_State* L, int index)
{
    std::vector<NamedEntity> entities;
    if (!lua_istable(L, index)) return entities;
    for (lua_Integer i = 1; lua_rawgeti(L, index, i) == LUA_TTABLE; ++i) {
        NamedEntity& entity = entities.emplace_back();
        for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
            if (lua_isinteger(L, -1)) entity.tag = lua_tointeger(L, -1);
            if (lua_type(L, -1) == LUA_TSTRING) entity.kind = lua_tostring(L, -1);
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return entities;
}

} // namespace

void* Interpreter::State::allocate(void* state, void* block, std::size_t old_size, std::size_t new_size)
{
    State& self = *static_cast<State*>(state);
    if (!block) old_size = 0; // Lua then passes the type of an object instead
    const std::size_t limit = self.options.memory;
    if (new_size > old_size && limit > 0 && self.used + (new_size - old_size) > limit) return nullptr;
    void* moved = nullptr;
    if (new_size == 0) {
        std::free(block);
    } else {
        moved = std::realloc(block, new_size);
        if (!moved) return nullptr;
    }
    self.used = self.used - old_size + new_size;
    return moved;
}

/// Called every kHookInstructions instructions. After a request to stop it raises at every one, so that no
/// pcall can continue.
void Interpreter::State::hook(lua_State* L, lua_Debug*)
{
    State& self = of(L);
    if (self.why == Why::nothing) {
        self.steps += kHookInstructions;
        self.ask_host();
        if (self.stop) {
            self.why = Why::cancelled;
        } else if (self.options.instructions > 0 && self.steps > self.options.instructions) {
            self.why = Why::instructions;
            self.stop = true;
        }
    }
    if (!self.stop) return;
    lua_sethook(L, hook, LUA_MASKCOUNT, 1);
    luaL_error(L, "interrupted");
}

/// Message handler: keeps the error value and, if requested, the traceback.
int Interpreter::State::handle_message(lua_State* L)
{
    State& self = of(L);
    lua_settop(L, 1);
    if (self.options.traceback) {
        luaL_traceback(L, L, nullptr, 1);
        try {
            self.traceback = lua_tostring(L, -1);
        } catch (const std::bad_alloc&) {
            self.traceback.clear();
        }
        lua_settop(L, 1);
    }
    return 1;
}

int Interpreter::State::open(lua_State* L)
{
    const State& self = of(L);
    if (self.options.sandbox) {
        lua::open_sandbox_libraries(L);
    } else {
        luaL_openlibs(L);
        luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
        lua_pushcfunction(L, luaopen_lacuna);
        lua_setfield(L, -2, "lacuna");
    }
    if (self.options.print) {
        lua_pushcfunction(L, print);
        lua_setglobal(L, "print");
    }
    return 0;
}

int Interpreter::State::print(lua_State* L)
{
    const int count = lua_gettop(L);
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    for (int i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&buffer, '\t');
        luaL_tolstring(L, i, nullptr);
        luaL_addvalue(&buffer);
    }
    luaL_addchar(&buffer, '\n');
    luaL_pushresult(&buffer);
    std::size_t length = 0;
    const char* text = lua_tolstring(L, -1, &length);
    State& self = of(L);
    self.call_back([&] { self.options.print({text, length}); });
    if (self.thrown) luaL_error(L, "interrupted");
    return 0;
}

/// Calls a function of the host. Upvalues: the function, its `user` pointer and its path.
int Interpreter::State::call_host(lua_State* L)
{
    constexpr int kMost = 16; // numbers in and out; a function of place takes three
    double arguments[kMost] = {}, results[kMost] = {};
    const int count = lua_gettop(L);
    const char* const path = lua_tostring(L, lua_upvalueindex(3));
    if (count > kMost) lua::fail(L, "%s: a function of the host takes at most %d numbers", path, kMost);
    for (int i = 0; i < count; ++i) arguments[i] = luaL_checknumber(L, i + 1);
    const auto function = reinterpret_cast<HostFunction>(lua_touserdata(L, lua_upvalueindex(1)));
    void* const user = lua_touserdata(L, lua_upvalueindex(2));
    int made = -1;
    State& self = of(L);
    self.call_back(
        [&] { made = function(user, arguments, static_cast<std::size_t>(count), results, kMost); });
    if (self.thrown) luaL_error(L, "interrupted");
    if (made < 0 || made > kMost)
        lua::fail_as(L, "lua.host_function", "the host's function '%s' failed", path);
    for (int i = 0; i < made; ++i) lua_pushnumber(L, results[i]);
    return made;
}

Interpreter::State::State(InterpreterOptions asked) : options(std::move(asked))
{
    host.cancel = &stop;
    host.threads = options.threads;
    host.crew = options.crew;
    host.sandboxed = options.sandbox;
    if (!options.output_folder.empty())
        host.output_folder = std::make_shared<const io::Folder>(options.output_folder);
    if (options.log) host.log = [this](std::string_view line) { call_back([&] { options.log(line); }); };
    if (options.progress)
        host.progress = [this](std::string_view stage, double share) {
            ask_host();
            call_back([&] {
                if (!options.progress(stage, share)) stop = true;
            });
        };
    if (options.ended) host.ended = [this] { call_back([&] { options.ended(); }); };
    lua = lua_newstate(allocate, this);
    if (!lua) throw std::bad_alloc();
    *static_cast<State**>(lua_getextraspace(lua)) = this;
    try {
        protect([this](lua_State* L) {
            lua::set_host(L, &host);
            open(L);
            lua_settop(L, 0);
        });
    } catch (...) {
        lua_close(lua);
        throw;
    }
}

void Interpreter::State::start(bool is_run)
{
    check_free();
    running = true;
    why = Why::nothing;
    steps = 0;
    thrown = nullptr;
    traceback.clear();
    if (is_run) lua_sethook(lua, hook, LUA_MASKCOUNT, stop ? 1 : kHookInstructions);
}

void Interpreter::State::end() noexcept
{
    running = false;
    lua_sethook(lua, nullptr, 0, 0);
}

/// Throw the error on top of the stack, and pop it.
void Interpreter::State::fail(int status)
{
    const std::string kind = lua_typename(lua, lua_type(lua, -1));
    lua_pushcfunction(lua, read_error);
    lua_insert(lua, -2);
    const bool read = lua_pcall(lua, 1, 6, 0) == LUA_OK;
    const int first = lua_gettop(lua) - 5;
    std::string text = read ? text_at(lua, first) : "(error object is a " + kind + " value)";
    const std::string usual = status == LUA_ERRSYNTAX ? "lua.syntax"
                              : status == LUA_ERRMEM  ? "lua.memory"
                              : status == LUA_ERRFILE ? "lua.no_recipe"
                                                      : "lua.error";
    const std::string code = read ? text_at(lua, first + 2) : "";
    ScriptError error(code.empty() ? usual : code, text);
    error.traceback = traceback;
    if (read && !text_at(lua, first + 1).empty()) {
        error.message = text_at(lua, first + 1);
        error.file = text_at(lua, first + 3);
        error.line = lua_isinteger(lua, first + 4) ? static_cast<int>(lua_tointeger(lua, first + 4)) : 0;
    } else {
        // Lua's own format: "recipe.lua:7: message".
        error.message = text;
        for (std::size_t colon = text.find(':'); colon != std::string::npos;
             colon = text.find(':', colon + 1)) {
            const std::size_t end = text.find_first_not_of("0123456789", colon + 1);
            if (end == std::string::npos || end == colon + 1 || text.compare(end, 2, ": ") != 0) continue;
            error.file = text.substr(0, colon);
            std::from_chars(text.data() + colon + 1, text.data() + end, error.line);
            error.message = text.substr(end + 2);
            break;
        }
    }
    if (read) error.entities = entities_at(lua, first + 5);
    lua_settop(lua, read ? first - 1 : first + 4);
    throw error;
}

/// Call the function below `arguments` values; its results are left on the stack.
void Interpreter::State::call(int arguments, int results, bool is_run)
{
    if (!lua_checkstack(lua, LUA_MINSTACK)) throw std::bad_alloc();
    start(is_run);
    struct Ended {
        State& self;
        ~Ended() { self.end(); }
    } const ended{*this};
    const PlainNumbers numbers;
    const int base = lua_gettop(lua) - arguments;
    lua_pushcfunction(lua, handle_message); // Lua reserves a stack slot for it
    lua_insert(lua, base);
    const int status = lua_pcall(lua, arguments, results, base);
    lua_remove(lua, base);
    // The run is incomplete: a stop was requested during its last instructions, or the recipe caught the
    // error.
    if (is_run && (thrown || stop)) {
        lua_settop(lua, base - 1);
        const bool limited = why == Why::instructions;
        stop = false;
        if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
        if (!limited) throw Cancelled();
        ScriptError error("lua.instructions",
                          formatted("the limit of {} instructions is exceeded; raise the option "
                                    "'instructions'",
                                    options.instructions));
        error.message = error.what();
        throw error;
    }
    if (status != LUA_OK) fail(status);
}

Value Interpreter::State::value_at(int index) const
{
    switch (lua_type(lua, index)) {
    case LUA_TBOOLEAN:
        return lua_toboolean(lua, index) != 0;
    case LUA_TNUMBER:
        if (lua_isinteger(lua, index)) return static_cast<std::int64_t>(lua_tointeger(lua, index));
        return lua_tonumber(lua, index);
    case LUA_TSTRING:
        return text_at(lua, index);
    default:
        return {};
    }
}

Interpreter::Interpreter(InterpreterOptions options) : state_(std::make_unique<State>(std::move(options))) {}
Interpreter::~Interpreter() = default;

void Interpreter::cancel() noexcept { state_->stop = true; }
void Interpreter::resume() noexcept { state_->stop = false; }
lua_State* Interpreter::state() const noexcept { return state_->lua; }

Value Interpreter::call(int arguments)
{
    state_->check_free();
    const int base = lua_gettop(state_->lua) - arguments - 1;
    state_->call(arguments, 1);
    Value result = state_->value_at(-1);
    lua_settop(state_->lua, base);
    return result;
}

Value Interpreter::run_file(const std::string& path, const std::vector<std::string>& words)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) {
        lua_pushboolean(L, 0);
        lua_setfield(L, LUA_REGISTRYINDEX, lua::kUsedParams);
        lua::push(L, words);
        lua_pushstring(L, path.c_str());
        lua_rawseti(L, -2, 0);
        lua_pushliteral(L, "lacuna");
        lua_rawseti(L, -2, -1);
        lua_setglobal(L, "arg");
    });
    int loaded = LUA_OK;
    self->protect([&](lua_State* L) {
        // Bytecode can crash the interpreter, so the sandbox loads text only.
        const char* const mode = self->options.sandbox ? "t" : nullptr;
        loaded = luaL_loadfilex(L, path == "-" ? nullptr : path.c_str(), mode);
        if (loaded != LUA_OK) return;
        luaL_checkstack(L, static_cast<int>(words.size()) + LUA_MINSTACK, "too many words");
        for (const std::string& word : words) lua_pushlstring(L, word.data(), word.size());
    });
    if (loaded != LUA_OK) self->fail(loaded);
    self->call(static_cast<int>(words.size()), 1);
    return self->value_at(-1);
}

Value Interpreter::run_string(std::string_view text, const std::string& name)
{
    const State::Visit self(*state_);
    const std::string chunk = "=" + name;
    int loaded = LUA_OK;
    self->protect([&](lua_State* L) {
        const char* const mode = self->options.sandbox ? "t" : nullptr;
        loaded = luaL_loadbufferx(L, text.data(), text.size(), chunk.c_str(), mode);
    });
    if (loaded != LUA_OK) self->fail(loaded);
    self->call(0, 1);
    return self->value_at(-1);
}

bool Interpreter::words_used()
{
    const State::Visit self(*state_);
    self->protect([](lua_State* L) { lua_getfield(L, LUA_REGISTRYINDEX, lua::kUsedParams); });
    return lua_toboolean(self->lua, -1) != 0;
}

} // namespace lacuna
