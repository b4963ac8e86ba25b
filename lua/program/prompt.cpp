// SPDX-License-Identifier: MIT
// Input and line editing. Evaluation, printing and completion are in lua/program/prompt.lua.
#include "program/prompt.h"

#include "program/chunks.h"
#include "program/stopping.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <unistd.h>
#include <vector>

#ifdef LACUNA_WITH_EDITLINE
#include <editline/readline.h>
#endif

namespace lacuna::program {

namespace {

/// Call a function of prompt.lua with strings.
Value ask(Interpreter& interpreter, const char* function, std::initializer_list<std::string_view> texts)
{
    lua_State* const L = interpreter.state();
    lua_getfield(L, LUA_REGISTRYINDEX, "lacuna.prompt");
    lua_getfield(L, -1, function);
    lua_remove(L, -2);
    for (const std::string_view text : texts) lua_pushlstring(L, text.data(), text.size());
    return interpreter.call(static_cast<int>(texts.size()));
}

#ifdef LACUNA_WITH_EDITLINE

Interpreter* g_completing = nullptr; // callbacks of editline have no user data

/// Files whose paths begin with `path`; folders get a slash at the end.
std::vector<std::string> files_from(const std::string& path)
{
    namespace fs = std::filesystem;
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string whole = folder + entry->path().filename().string();
        std::error_code unknown;
        if (whole.starts_with(path)) files.push_back(whole + (entry->is_directory(unknown) ? "/" : ""));
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Completions of `text`, the last word of the input. prompt.lua answers with one completion per line, or
/// with the position at which a path begins.
std::vector<std::string> words_for(const char* text)
{
    std::vector<std::string> words;
    try {
        const std::string typed(rl_line_buffer, static_cast<std::size_t>(rl_point));
        const Value found = ask(*g_completing, "complete", {typed, text});
        if (const auto* quote = std::get_if<std::int64_t>(&found)) {
            const auto begin = static_cast<std::size_t>(*quote);
            const std::size_t there = typed.size() - begin -
                                      std::min(std::strlen(text), typed.size() - begin);
            for (const std::string& file : files_from(typed.substr(begin)))
                words.push_back(file.substr(there));
            return words;
        }
        if (const auto* lines = std::get_if<std::string>(&found))
            for (std::size_t at = 0; at < lines->size();) {
                const std::size_t end = std::min(lines->find('\n', at), lines->size());
                words.push_back(lines->substr(at, end - at));
                at = end + 1;
            }
    } catch (const std::exception&) { // no completions
    }
    return words;
}

char* complete(const char* text, int state)
{
    static std::vector<std::string> words;
    if (state == 0) words = words_for(text);
    return static_cast<std::size_t>(state) < words.size()
               ? strdup(words[static_cast<std::size_t>(state)].c_str())
               : nullptr;
}

char** complete_words(const char* text, int, int)
{
    rl_completion_append_character = '\0';
    rl_attempted_completion_over = 1;
    return rl_completion_matches(text, complete);
}

#endif

/// Reads lines: with editing and history at a terminal, plain lines otherwise.
class Lines {
public:
    Lines(Interpreter& interpreter, std::string history)
        : edited_(isatty(STDIN_FILENO) && isatty(STDOUT_FILENO)), history_(std::move(history))
    {
#ifdef LACUNA_WITH_EDITLINE
        if (!edited_) return;
        g_completing = &interpreter;
        rl_readline_name = const_cast<char*>("lacuna");
        rl_initialize();
        rl_attempted_completion_function = complete_words;
        rl_basic_word_break_characters = const_cast<char*>(" \t\n\"\\'`@$><=;|&{([,+-*/#^~%");
        using_history();
        if (!history_.empty()) read_history(history_.c_str());
#else
        (void)interpreter;
#endif
    }
    ~Lines()
    {
#ifdef LACUNA_WITH_EDITLINE
        if (edited_ && !history_.empty() && write_history(history_.c_str()) != 0)
            std::fprintf(stderr, "lacuna: cannot write the history to %s\n", history_.c_str());
#endif
    }
    Lines(const Lines&) = delete;
    Lines& operator=(const Lines&) = delete;

    /// Read the next line; empty at the end of the input or after Ctrl-C, which sets `given_up`.
    [[nodiscard]] std::optional<std::string> next(const char* prompt, bool& given_up) const
    {
        begin_idle();
        std::optional<std::string> line = read(prompt);
        given_up = end_idle();
        if (!given_up) return line;
        if (!line) std::puts("");
        return std::nullopt;
    }
    [[nodiscard]] bool at_terminal() const { return edited_; }

private:
    [[nodiscard]] std::optional<std::string> read(const char* prompt) const
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
        std::clearerr(stdin); // after Ctrl-C
        for (int c = std::getchar(); c != '\n'; c = std::getchar()) {
            if (c == EOF) return text.empty() ? std::nullopt : std::optional(text);
            text += static_cast<char>(c);
        }
        return text;
    }
    bool edited_;
    std::string history_;
};

/// Run a statement; read more lines while it is incomplete.
void run_statement(Interpreter& interpreter, std::string text, const Lines& lines)
{
    while (true) {
        const Value more = ask(interpreter, "run", {text});
        if (!std::holds_alternative<bool>(more) || !std::get<bool>(more)) return;
        bool given_up = false;
        const std::optional<std::string> line = lines.next(">> ", given_up);
        if (given_up) return;
        if (!line) {
            ask(interpreter, "run", {text, "no more"});
            return;
        }
        text += "\n" + *line;
    }
}

} // namespace

void run_prompt(Interpreter& interpreter, const std::string& history, ProgressLine& progress)
{
    lua_State* const L = push_chunk(interpreter, "prompt");
    const char* const stub = chunk_text("lacuna");
    lua_pushstring(L, stub);
    lua_createtable(L, 0, 3); // filled by the chunk
    lua_pushvalue(L, -1);
    lua_setfield(L, LUA_REGISTRYINDEX, "lacuna.prompt");
    luaopen_debug(L); // a separate table, hidden from recipes in the sandbox
    interpreter.call(3);

    const char* const named = std::getenv("LACUNA_HISTORY");
    const Lines lines(interpreter, !history.empty() ? history : named ? named : "");
    if (lines.at_terminal())
        std::printf("lacuna %s, %s; type help for an overview, exit to leave\n", LACUNA_VERSION, LUA_RELEASE);
    while (true) {
        bool given_up = false;
        const std::optional<std::string> line = lines.next("> ", given_up);
        if (given_up) continue;
        if (!line) break;
        try {
            if (std::get<bool>(ask(interpreter, "leaves", {*line}))) break;
            run_statement(interpreter, *line, lines);
            progress.clear();
        } catch (const ScriptError& error) {
            progress.clear();
            std::fflush(stdout);
            report(error);
        } catch (const Cancelled&) {
            progress.clear();
            std::fflush(stdout);
            // SIGTERM and SIGHUP end the prompt as they end a recipe; Ctrl-C ends only the statement.
            if (report_stop(0) != Exit::interrupted) throw Cancelled();
        }
    }
}

} // namespace lacuna::program
