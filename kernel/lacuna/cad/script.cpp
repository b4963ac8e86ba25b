// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/script.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace lacuna::cad {

namespace {

/// Forbidden commands, and what they do.
struct Word {
    std::string_view word, does;
};
constexpr std::array kRefused{
    Word{"SystemCall", "runs a command"},   Word{"NonBlockingSystemCall", "runs a command"},
    Word{"System", "runs a command"},       Word{"OnelabRun", "runs a program"},
    Word{"OnelabAction", "runs a program"}, Word{"CreateOverlay", "writes files"},
};
/// Commands that write files or generate a mesh instead of geometry. Words are between blanks.
constexpr std::string_view kSkipped =
    " Save Print CreateFile Plugin Mesh Remesh RefineMesh OptimizeMesh AdaptMesh RelocateMesh RecombineMesh "
    "TransformMesh SetOrder PartitionMesh UnpartitionMesh RenumberMeshNodes RenumberMeshElements ";
/// Words that begin and end blocks of commands that may run several times or never. Words are between blanks.
constexpr std::string_view kBegins = " If For Macro Function ", kEnds = " EndIf EndFor Return ";
/// Commands that are followed by a file name. Words are between blanks.
constexpr std::string_view kFiles = " Include Merge MergeFile ShapeFromFile ListFromFile ";

class Scanner {
public:
    Scanner(const std::string& path, std::string_view text) : path_(path), text_(text) {}

    ScriptContent run()
    {
        while (skip_to_code(), at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                (void)quoted();
            } else if (is_letter(c)) {
                word();
            } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
                // Skip the exponent of a number, as in 1e5: it is not a word.
                while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
            } else {
                ++at_;
            }
        }
        return std::move(content_);
    }

private:
    static bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

    [[noreturn]] void refuse(const std::string& what, Format<0> remedy) const
    {
        throw InvalidInput(Message("cad.script", "{}, line {}: {}", path_, line_, what).remedy(remedy));
    }
    void step()
    {
        if (text_[at_] == '\n') ++line_;
        ++at_;
    }
    void skip_to_code()
    {
        while (at_ < text_.size()) {
            const std::string_view left = text_.substr(at_);
            if (left.starts_with("//")) {
                while (at_ < text_.size() && text_[at_] != '\n') ++at_;
            } else if (left.starts_with("/*")) {
                const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
                while (at_ < end) step();
                at_ = std::min(at_ + 2, text_.size());
            } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
                step();
            } else {
                return;
            }
        }
    }
    std::string quoted()
    {
        const char quote = text_[at_];
        std::string inside;
        for (++at_; at_ < text_.size() && text_[at_] != quote; step()) {
            // In Gmsh, a backslash before a quote escapes the quote.
            if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] == quote) step();
            inside += text_[at_];
        }
        if (at_ < text_.size()) ++at_;
        return inside;
    }
    void word()
    {
        const std::size_t from = at_;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        const std::string_view found = text_.substr(from, at_ - from);
        // "Print.Background" is an option, and scripts may set options.
        if (at_ < text_.size() && text_[at_] == '.') return;
        for (const Word& refused : kRefused)
            if (found == refused.word)
                refuse(formatted("{} {}", found, refused.does),
                       "remove it: a script may only make geometry, and include files from its own folder");
        const auto is_one_of = [between = formatted(" {} ", found)](std::string_view words) {
            return words.find(between) != std::string_view::npos;
        };
        depth_ += is_one_of(kBegins) ? 1 : is_one_of(kEnds) ? -1 : 0;
        if (found == "Exit") return end_at(from);
        const bool skipped = is_one_of(kSkipped);
        if (found == "Printf" || (skipped && begins_command(found))) command(found, from);
        if (is_one_of(kFiles)) file(found);
    }
    /// Whether the word is used as a command and not as a variable name.
    bool begins_command(std::string_view found)
    {
        skip_to_code();
        const char next = at_ < text_.size() ? text_[at_] : '\0';
        return next == '"' || next == '\'' || next == '(' || is_letter(next) ||
               (found != "Mesh" && (next == ';' || next == '{'));
    }
    /// Remove the command that began at `from`. Printf is removed only if it writes to a file:
    /// Printf ("…") > "file".
    void command(std::string_view found, std::size_t from)
    {
        const std::string word(found);
        const int line = line_;
        bool leaves = word != "Printf";
        for (int depth = 0; skip_to_code(), at_ < text_.size() && (depth > 0 || text_[at_] != ';');) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                (void)quoted();
                continue;
            }
            leaves = leaves || (c == '>' && depth == 0);
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            ++at_;
        }
        if (!leaves) return;
        if (at_ < text_.size()) return content_.skipped.push_back({word, line, from, ++at_});
        line_ = line;
        refuse(formatted("{} has no ';' at its end", word), "add the ';'");
    }
    /// Remove everything from `from` on: Gmsh does not execute it.
    void end_at(std::size_t from)
    {
        if (depth_ != 0)
            refuse("Exit is inside If, For or a macro, so the end of the script is not known",
                   "move Exit out of the block, or remove it");
        content_.skipped.push_back({"Exit", line_, from, text_.size()});
        at_ = text_.size();
    }
    void file(std::string_view found)
    {
        skip_to_code();
        if (at_ < text_.size() && text_[at_] == '(') {
            ++at_;
            skip_to_code();
        }
        const int line = line_;
        std::string name;
        if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) name = quoted();
        if (name.starts_with("./")) name.erase(0, 2);
        if (name.empty())
            refuse(formatted("{} needs the name of a file in quotes", found), "write the name in quotes");
        if (name.find_first_of("/\\") != std::string::npos || name == "..")
            refuse(formatted("{} names {}, which is in another folder", found, name),
                   "copy that file to the folder of the script");
        content_.files.push_back({name, line});
    }

    const std::string& path_;
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1, depth_ = 0; ///< line number, and nesting depth of the commands of `kBegins`
    ScriptContent content_;
};

} // namespace

ScriptContent look_through_script(const std::string& path, std::string_view text)
{
    return Scanner(path, text).run();
}

} // namespace lacuna::cad
