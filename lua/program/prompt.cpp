// SPDX-License-Identifier: MIT
#include "program/interpreter.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <unistd.h>

#ifdef LACUNA_WITH_EDITLINE
#include <editline/readline.h>
#endif

namespace lacuna::program {

namespace {

#ifdef LACUNA_WITH_EDITLINE

lua_State* g_completing = nullptr; // editline hands its callbacks nothing of ours

/// Push the table named by the dotted path before the last word; nil where there is none.
void push_owner(lua_State* L, const std::string& path)
{
    lua_pushglobaltable(L);
    for (std::size_t at = 0; at < path.size();) {
        const std::size_t dot = path.find_first_of(".:", at);
        if (dot == std::string::npos) return;
        if (lua_istable(L, -1)) {
            lua_pushlstring(L, path.data() + at, dot - at);
            lua_rawget(L, -2); // raw: completing must run nobody's code
            lua_remove(L, -2);
        } else if (luaL_getmetafield(L, -1, "methods") == LUA_TTABLE) {
            lua_remove(L, -2);
        }
        at = dot + 1;
    }
    if (lua_isuserdata(L, -1) && luaL_getmetafield(L, -1, "methods") == LUA_TTABLE) lua_remove(L, -2);
}

char* complete(const char* text, int state)
{
    static std::string owner, start;
    static int skip = 0;
    if (state == 0) {
        const std::string whole = text;
        const std::size_t dot = whole.find_last_of(".:");
        owner = dot == std::string::npos ? "" : whole.substr(0, dot + 1);
        start = whole.substr(owner.size());
        skip = 0;
    }
    lua_State* L = g_completing;
    const int top = lua_gettop(L);
    push_owner(L, owner);
    char* found = nullptr;
    int seen = 0;
    if (lua_istable(L, -1))
        for (lua_pushnil(L); !found && lua_next(L, -2); lua_pop(L, 1)) {
            if (lua_type(L, -2) != LUA_TSTRING) continue;
            const char* name = lua_tostring(L, -2);
            if (std::strncmp(name, start.c_str(), start.size()) == 0 && seen++ == skip)
                found = strdup((owner + name).c_str());
        }
    lua_settop(L, top);
    ++skip;
    return found;
}

char** complete_words(const char* text, int, int)
{
    rl_completion_append_character = '\0';
    rl_attempted_completion_over = 1; // no file names after ours
    return rl_completion_matches(text, complete);
}

std::string history_file()
{
    const char* home = std::getenv("HOME");
    return home ? std::string(home) + "/.lacuna_history" : std::string();
}

#endif

/// Where lines come from: an edited line with history at a terminal, plain ones elsewhere.
class Lines {
public:
    explicit Lines(lua_State* L) : edited_(isatty(STDIN_FILENO) && isatty(STDOUT_FILENO))
    {
#ifdef LACUNA_WITH_EDITLINE
        if (!edited_) return;
        g_completing = L;
        rl_readline_name = const_cast<char*>("lacuna");
        rl_attempted_completion_function = complete_words;
        rl_basic_word_break_characters = const_cast<char*>(" \t\n\"\\'`@$><=;|&{([,+-*/#^~%");
        using_history();
        if (const std::string file = history_file(); !file.empty()) read_history(file.c_str());
#else
        (void)L;
#endif
    }
    ~Lines()
    {
#ifdef LACUNA_WITH_EDITLINE
        if (const std::string file = history_file(); edited_ && !file.empty()) write_history(file.c_str());
#endif
    }
    Lines(const Lines&) = delete;
    Lines& operator=(const Lines&) = delete;

    std::optional<std::string> next(const char* prompt) const
    {
#ifdef LACUNA_WITH_EDITLINE
        if (edited_) {
            char* line = readline(prompt);
            if (!line) return std::nullopt;
            std::string text = line;
            std::free(line);
            if (!text.empty()) add_history(text.c_str());
            return text;
        }
#endif
        if (isatty(STDIN_FILENO)) std::fputs(prompt, stdout), std::fflush(stdout);
        std::string text;
        for (int c = std::getchar(); c != '\n'; c = std::getchar()) {
            if (c == EOF) return text.empty() ? std::nullopt : std::optional(text);
            text += static_cast<char>(c);
        }
        return text;
    }
    [[nodiscard]] bool at_terminal() const { return edited_; }

private:
    bool edited_;
};

bool load(lua_State* L, const std::string& text)
{
    return luaL_loadbufferx(L, text.data(), text.size(), "=prompt", "t") == LUA_OK;
}

/// True when the message on top says that the chunk only lacks its end.
bool is_unfinished(lua_State* L)
{
    const std::string_view message = lua_tostring(L, -1);
    return message.ends_with("<eof>");
}

/// Load what was typed, first as an expression; asks for more lines while it is unfinished.
bool load_statement(lua_State* L, std::string text, const Lines& lines)
{
    if (load(L, "return " + text)) return true;
    lua_pop(L, 1);
    while (!load(L, text)) {
        if (!is_unfinished(L)) return false;
        const std::optional<std::string> more = lines.next(">> ");
        if (!more) return false;
        lua_pop(L, 1);
        text += "\n" + *more;
    }
    return true;
}

/// print(...) of what stands above `base`.
void print_results(Interpreter& interpreter, int base)
{
    lua_State* L = interpreter.state();
    const int results = lua_gettop(L) - base;
    if (results == 0) return;
    lua_getglobal(L, "print");
    lua_insert(L, base + 1);
    interpreter.call(results, 0);
}

} // namespace

Exit run_prompt(Interpreter& interpreter)
{
    lua_State* L = interpreter.state();
    if (interpreter.run_text("lacuna = require 'lacuna'", "") != Exit::done) return Exit::failed;
    const Lines lines(L);
    if (lines.at_terminal()) std::printf("lacuna %s, %s; Ctrl-D leaves\n", LACUNA_VERSION, LUA_RELEASE);
    watch_interrupts(false);
    while (const std::optional<std::string> line = lines.next("> ")) {
        const int base = lua_gettop(L);
        watch_interrupts(true);
        if (!load_statement(L, *line, lines))
            interpreter.report();
        else if (interpreter.call(0, LUA_MULTRET) == Exit::done)
            print_results(interpreter, base);
        watch_interrupts(false);
        interpreter.resume_after_stop();
        lua_settop(L, base);
    }
    return Exit::done;
}

} // namespace lacuna::program
