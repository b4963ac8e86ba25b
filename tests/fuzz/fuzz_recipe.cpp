// SPDX-License-Identifier: MIT
//
// Text as a recipe in the sandbox, run as `lacuna --sandbox` does, in a child process for each. Bytes are
// choices in a grammar of the recipe language, changes to the text that comes of them, or the text itself. A
// recipe ends with exit code 0, or with 1 and a sentence; all else is a fault: a report of a sanitizer, a
// signal, time beyond the limit, a file outside the output folder. Without libFuzzer:
//   fuzz_recipe [--runs N] [--seconds S] [--seed N] [--show] [FILE...]
#include "program/stopping.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {
constexpr int kReported = 99; // exit code after a sanitizer's report: 1 is that of a failed recipe
} // namespace

// The memory left at the end of a child is looked at by fuzz_lua_api; here it would take most of the time.
extern "C" const char* __asan_default_options()
{
    return "exitcode=99:allocator_may_return_null=1:detect_leaks=0";
}

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string recipe; // at work

[[noreturn]] void fault(const std::string& what)
{
    const fs::path kept = fs::temp_directory_path() / "fuzz_found.lua";
    std::ofstream(kept, std::ios::binary) << recipe;
    std::fprintf(stderr, "fuzz_recipe: fault: %s\nkept in %s\n", what.c_str(), kept.c_str());
    std::abort();
}

// --- the recipe language, as far as docs/reference.md tells it -------------------------------------------

/// `<name>` in a way stands for one of the ways of the rule `name`. The first way of a rule ends it soonest.
struct Rule {
    std::string_view name;
    std::vector<std::string_view> ways;
};

const std::vector<Rule>& grammar()
{
    static const std::vector<Rule> rules = {
        {"recipe",
         {"local lacuna = require 'lacuna'\nlocal m = <sound>\n"
          "local v = m:open_volume { source = 'source', target = 'target', walls = 'auto' }\n"
          "local s = v:sweep { layers = 2, size = 0.5, improve = false }\n<tries>",
          "lacuna = require 'lacuna'\nm = <sound>\nv = m:open_volume()\n<tries>",
          "lacuna = require 'lacuna'\nm = <model>\nv = <volume>\n<steps>"}},
        {"sound",
         {"lacuna.synthetic.prism()", "lacuna.synthetic.prism { sides = <few>, facets = 2, twist = 20 }",
          "lacuna.synthetic.barrel { facets = 2 }", "lacuna.synthetic.annulus { facets = 1 }",
          "lacuna.synthetic.plate { facets = 1, holes = 1 }", "lacuna.synthetic.elbow { facets = 1 }"}},
        {"tries", {"<try>\n", "<try>\n<tries>", "<try>\n<try>\n<tries>", "<try>\n<try>\n<tries>"}},
        {"try",
         {"print(m)", "pcall(function() <call> end)", "pcall(function() print(<call>) end)",
          "pcall(function() <call> <call> end)", "pcall(function() <lua> end)",
          "pcall(function() s = v:sweep(<sweep>) end)", "pcall(function() v = <volume> end)",
          "pcall(function() m = <model> v = <volume> end)", "for i = 1, <few> do <try> end"}},
        {"steps", {"<step>\n", "<step>\n<steps>", "<step>\n<step>\n<steps>", "<step>\n<step>\n<steps>"}},
        {"step", {"print(m)", "<try>", "<call>", "local r = <call>", "<lua>", "s = v:sweep(<sweep>)"}},
        {"model",
         {"lacuna.synthetic.prism()", "lacuna.synthetic.prism { <prism>, drop = <drop> }",
          "lacuna.synthetic.prism { <prism>, drop = <drop> }",
          "lacuna.synthetic.annulus { <tube>, height = <length>, drop = <drop> }",
          "lacuna.synthetic.elbow { <tube>, angle = <number>, drop = <drop> }",
          "lacuna.synthetic.barrel { facets = 1, height = <length>, bulge = <number>, drop = <drop> }",
          "lacuna.synthetic.plate { facets = 1, length = <length>, holes = <count>, drop = <drop> }",
          "lacuna.load 'given.stl'", "lacuna.load(<input>)", "lacuna.load(<input>, { <load> })",
          "lacuna.model()"}},
        {"prism",
         {"facets = 1", "sides = <few>, facets = <few>, height = <length>, twist = <number>",
          "sides = 4, facets = 2, holes = <few>, hole_radius = 0.1, taper = <number>",
          "radius = <length>, bend = <number>, facets = <count>"}},
        {"tube", {"facets = 1", "inner = <length>, facets = 2", "inner = <number>, facets = <count>"}},
        {"drop", {"'walls'", "'target'", "{ 'target', 'wall_1' }", "{}", "'source'", "<value>"}},
        {"load",
         {"tolerance = <number>", "feature_angle = <number>, keep_mesh = <truth>", "scale = <number>"}},
        {"volume",
         {"m:open_volume()", "m:open_volume { source = <faces>, target = <faces> }",
          "m:open_volume { source = 'source', target = 'target', walls = 'auto' }",
          "m:open_volume { faces = <faces>, class = <class> }",
          "m:open_volume { source = 'source', target = 'target', walls = <faces>, class = <class> }",
          "m:open_volume { source = <faces>, walls = <faces>, name = <word>, reading = <count> }"}},
        {"faces",
         {"'source'", "'target'", "<count>", "{ <faces>, <faces> }", "m:face(<faces>)", "m:faces()[<count>]",
          "{ facing = <vector> }", "{ near = <vector> }", "{ area = { <number>, <number> } }",
          "{ kind = 'plane', tags = { 1, <count> } }", "{ box = { <vector>, <vector> } }",
          "{ touching = m:face(<count>) }", "{ free = <truth> }", "<value>"}},
        {"class", {"'I'", "'II'", "'III'", "'IV'", "'V'", "'closed'", "<value>"}},
        {"call",
         {"v:describe()",
          "m:describe()",
          "m:faces(<selector>)",
          "m:face(<faces>)",
          "m:add_face { name = <word>, points = { <vector>, <vector>, <vector> }, cells = { { 1, 2, 3 } } }",
          "m:add_face { points = <value>, cells = { { 1, <count>, 3, <count> } } }",
          "m:face_from { near = <vector>, angle = <number> }",
          "m:view(<path>)",
          "m:open_volume(<value>)",
          "v:classify()",
          "v:override_class(<class>)",
          "v:match()",
          "v:match { vertices = { { <count>, <count> } }, method = 'nearest' }",
          "v:match { loops = { { <count>, <count> } }, flip = { <count> } }",
          "v:close()",
          "v:close { edge_shape = 'follow', cap = <word> }",
          "v:cut { plane = { <vector>, <vector> } }",
          "v:is_watertight()",
          "v:free_edges()",
          "v:tree()",
          "v:sweep(<sweep>)",
          "v:sweep_to(<path>, <sweep>)",
          "v:write_facets(<path>)",
          "v:write_cad(<path>)",
          "s:quality()",
          "s:groups()",
          "s:node(<count>)",
          "s:hex(<count>)",
          "s:write(<path>)",
          "s:write(<path>, { version = 2.2, binary = <truth>, quality = <truth> })",
          "s:write(<path>, { with = m, first_node = <count>, element = <word> })",
          "s:picture(<path>)",
          "s:view(<path>)",
          "lacuna.check(<input>)",
          "lacuna.params { width = <number>, name = <word> }",
          "lacuna.assembly { v, v }",
          "lacuna.gmsh_version",
          "lacuna[<word>](<value>)",
          "m[<word>](m, <value>)",
          "v[<word>](v, <value>)",
          "(<object>).<field>",
          "getmetatable(<object>)[<word>](<object>)"}},
        {"selector", {"nil", "{ name = <word> }", "<faces>", "{ radius = { <number>, <number> } }"}},
        {"field", {"class", "nodes", "hexes", "layers", "report", "fidelity", "tag", "name", "kind", "area"}},
        {"object", {"m", "v", "s", "m:face(1)", "lacuna", "s:quality()", "s.report"}},
        {"sweep",
         {"{ layers = 2, size = 0.5 }", "{ layers = <layers>, size = <size>, <option> }",
          "{ layers = <layers>, size = <size>, <option>, <option>, <option> }", "<value>"}},
        {"layers",
         {"2", "<count>", "{ 0.3, 1 }", "{ <number>, <number>, 1 }",
          "{ count = <count>, bias = <number>, mode = 'bell' }", "<value>"}},
        {"size",
         {"0.5", "<length>", "<number>", "function(x, y, z) return 0.3 + 0.1 * x end",
          "function(x) <callback> return 0.5 end", "function() return <value> end"}},
        {"callback",
         {"collectgarbage()", "v = nil m = nil collectgarbage()", "coroutine.yield(x)", "error(<value>)",
          "v:close()", "v:sweep { layers = 1, size = 1 }", "do local c <close> = v end",
          "v:override_class(<class>)", "v = <volume>", "<step>"}},
        {"option",
         {"improve = false", "quads = 'paved'", "quads = 'mapped'", "quads = 'keep'", "quads = 'gmsh'",
          "rows = <count>, row_height = <size>", "order = 2, serendipity = <truth>", "order = <count>",
          "min_scaled_jacobian = <number>", "improve = { iterations = <count>, seconds = <number> }",
          "threads = <count>", "curvature = <count>", "gap = <count>", "max_deviation = <number>",
          "wedges = <truth>", "boundary_layers = { first = <length>, growth = 1.2, count = 2 }",
          "<word2> = <value>"}},
        {"path",
         {"'out.msh'",
          "'a.vtu'",
          "'sub/a.vtk'",
          "'b.inp'",
          "'c.bdf'",
          "'d.unv'",
          "'e.stl'",
          "'f.obj'",
          "'g.html'",
          "'link/x.msh'",
          "'../x.msh'",
          "'../elsewhere/x.stl'",
          "'sub/../../x.msh'",
          "'HOME/x.msh'",
          "'HOME/out/ok.msh'",
          "'HOME/elsewhere/x.vtk'",
          "'linked.msh'",
          "'none/x.msh'",
          "'x'",
          "''",
          "'a\\0.msh'",
          "('n'):rep(300) .. '.msh'",
          "'.'",
          "'sub'",
          "<value>"}},
        {"input",
         {"'given.stl'", "'out/out.msh'", "'given.obj'", "'none.msh'", "'/dev/zero'", "'out'",
          "{ 'given.stl', 'given.obj' }", "'x.step'", "'x.geo'", "''", "<value>"}},
        {"lua",
         {"local x = <value>",
          "setmetatable({}, { __gc = function() <callback> end })",
          "local c <close> = setmetatable({}, { __close = function() <callback> end })",
          "local co = coroutine.wrap(function(x) <callback> <step> end) co(1) co()",
          "for _ = 1, 3 do pcall(function(x) <callback> end) end",
          "local t = {} for i = 1, 200000 do t[i] = { i } end",
          "local x = ('ab'):rep(1e9)",
          "local function f(x) return f(x) + 1 end f(1)",
          "local t = {} for i = 1, 200 do t = { t } end m:open_volume(t)",
          "print(pcall(load, <value>))",
          "load('\\27Lua', 'x', 'b')",
          "error(setmetatable({}, { __tostring = function() <callback> return <value> end }))",
          "error(<value>)",
          "goto done ::done::",
          "collectgarbage('generational')",
          "print(os.getenv 'HOME')",
          "io.open(<path>, 'w')",
          "require(<word>)",
          "package.loadlib('x', '*')",
          "string.dump(print)",
          "while true do <callback> end",
          "repeat pcall(error) until false",
          "print(('%s%n'):format(<value>))",
          "table.sort({ 3, 1, 2, m, v }, function(a, b) return true end)",
          "setmetatable(_G, { __index = function(_, x) <callback> return <value> end })",
          "debug.sethook()"}},
        {"vector", {"{ 0, 0, 1 }", "{ <number>, <number>, <number> }", "{ 0, 0, -1 }", "<value>"}},
        {"count", {"1", "2", "3", "0", "5", "-1", "7", "1000000", "2147483647", "math.mininteger"}},
        {"few", {"3", "4", "5"}},
        {"length", {"0.5", "1", "0.3", "2", "0.05"}},
        {"number",
         {"1", "0.5", "0", "-1", "30", "1e-9", "1e308", "-1e-320", "1/0", "0/0", "2^53", "0x1p-1074", "90"}},
        {"truth", {"true", "false", "nil", "1"}},
        {"word",
         {"'wall_1'", "'source'", "''", "'a\\0b'", "'sweep'", "'close'", "'load'", "'__gc'", "'\\255'",
          "'synthetic'", "('x'):rep(500)", "'lacuna'", "'C3D8I'"}},
        {"word2", {"size", "layer", "a", "improve", "order"}},
        {"value",
         {"nil", "<number>", "<word>", "<truth>", "<object>", "{}", "{ <value> }", "{ [<word>] = <value> }",
          "function(x) <callback> return <value> end", "print",
          "setmetatable({}, { __index = function(_, x) <callback> return <value> end })",
          "coroutine.create(print)", "{ <value>, <value>, <value> }", "(<call>)"}},
    };
    return rules;
}

/// Choices out of bytes; 0 when they are used up.
class Choices {
public:
    explicit Choices(std::string_view bytes) : bytes_(bytes) {}

    std::size_t below(std::size_t n)
    {
        std::size_t value = next();
        if (n > 256) value = value << 8 | next();
        return value % n;
    }
    char byte() { return static_cast<char>(next()); }
    [[nodiscard]] bool used_up() const { return at_ >= bytes_.size(); }

private:
    unsigned char next() { return used_up() ? 0 : static_cast<unsigned char>(bytes_[at_++]); }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

void expand(std::string_view name, Choices& choices, int depth, std::string& text)
{
    constexpr int kDeepest = 24;              // nested ways
    constexpr std::size_t kLongest = 1 << 14; // of a recipe [bytes]
    const auto& rules = grammar();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule& r) { return r.name == name; });
    if (rule == rules.end()) fault("the grammar has no rule " + std::string(name));
    const bool ends = depth > kDeepest || text.size() > kLongest;
    std::string_view way = rule->ways[ends ? 0 : choices.below(rule->ways.size())];
    while (!way.empty()) {
        const std::size_t open = way.find('<');
        const std::size_t shut = open == way.npos ? way.npos : way.find('>', open);
        const std::string_view inner = shut == way.npos ? "" : way.substr(open + 1, shut - open - 1);
        if (inner.empty() || inner == "close") { // Lua's own: no place of a rule
            const std::size_t length = std::min(shut == way.npos ? way.size() : shut + 1, way.size());
            text += way.substr(0, length);
            way.remove_prefix(length);
            continue;
        }
        text += way.substr(0, open);
        expand(inner, choices, depth + 1, text);
        way.remove_prefix(shut + 1);
    }
}

void damage(std::string& text, Choices& choices)
{
    const std::size_t at = choices.below(text.size() + 1);
    const std::size_t from = choices.below(text.size() + 1);
    const std::size_t length = 1 + choices.below(30);
    switch (choices.below(5)) {
    case 0:
        text.insert(at, 1, choices.byte());
        break;
    case 1:
        text.erase(at, length);
        break;
    case 2:
        if (at < text.size()) text[at] = choices.byte();
        break;
    case 3:
        text.insert(at, text.substr(from, length));
        break;
    default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << choices.below(8)));
    }
}

// --- the sandbox and what is around it -------------------------------------------------------------------

/// A folder with files a recipe may read and a folder it may write to, left with the program.
class World {
public:
    World()
    {
        std::string made = (fs::temp_directory_path() / "fuzz_recipe_XXXXXX").string();
        if (!mkdtemp(made.data())) fault("no temporary folder");
        home_ = made;
        fs::create_directories(home_ / "elsewhere");
        std::ofstream(home_ / "elsewhere/y.msh") << "as it was";
        std::ofstream(home_ / "given.stl") << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                              "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
        std::ofstream(home_ / "given.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        fs::create_directory(home_ / "out");
        clear_output();
        before_ = outside();
        fs::current_path(home_);
        setenv("LACUNA_CAD", "/nonexistent", 1); // no CAD process: what needs one is an error
    }
    ~World()
    {
        fs::current_path("/");
        fs::remove_all(home_);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void clear_output()
    {
        for (const auto& entry : fs::directory_iterator(home_ / "out")) fs::remove_all(entry.path());
        fs::create_directories(home_ / "out/sub");
        fs::create_symlink(home_ / "elsewhere", home_ / "out/link");
        fs::create_symlink(home_ / "elsewhere/y.msh", home_ / "out/linked.msh");
    }
    void check_outside() const
    {
        if (outside() != before_) fault("something was written outside the output folder");
    }
    [[nodiscard]] const fs::path& home() const { return home_; }

private:
    /// Names, sizes and times of all that is not below the output folder.
    [[nodiscard]] std::vector<std::string> outside() const
    {
        std::vector<std::string> list;
        for (fs::recursive_directory_iterator at(home_), end; at != end; ++at) {
            if (at->path() == home_ / "out") {
                at.disable_recursion_pending();
                continue;
            }
            list.push_back(at->path().string());
            if (at->is_regular_file())
                list.back() += " " + std::to_string(at->file_size()) + " " +
                               std::to_string(at->last_write_time().time_since_epoch().count());
        }
        std::sort(list.begin(), list.end());
        return list;
    }

    fs::path home_;
    std::vector<std::string> before_;
};

// --- a run -------------------------------------------------------------------------------------------------

constexpr double kSeconds = 0.5;    // of a recipe
constexpr double kMegabytes = 128;  // of a recipe
constexpr double kMostSeconds = 30; // of a child: the limit, five seconds of grace, a slow machine

struct Ends {
    std::uint64_t runs = 0, done = 0, raised = 0;
    std::string said; // by the last one
};

[[noreturn]] void run_child(const World& world, int errors)
{
    using namespace lacuna::program;
    const int nowhere = open("/dev/null", O_WRONLY);
    if (dup2(nowhere, STDOUT_FILENO) < 0 || dup2(errors, STDERR_FILENO) < 0) _exit(kReported);
    lacuna::InterpreterOptions options;
    options.sandbox = true;
    options.output_folder = (world.home() / "out").string();
    options.memory = static_cast<std::size_t>(kMegabytes * 1024 * 1024);
    limit_process(kMegabytes, kSeconds);
    Exit result = Exit::done;
    {
        lacuna::Interpreter interpreter(std::move(options));
        watch_interrupts(&interpreter);
        try {
            interpreter.run_string(recipe);
        } catch (const lacuna::ScriptError& error) {
            report(error);
            result = Exit::failed;
        } catch (const lacuna::Cancelled&) {
            result = report_stop(kSeconds);
        }
        watch_interrupts(nullptr);
    }
    std::fflush(stdout);
    _exit(static_cast<int>(result));
}

/// The status of a child that ended; one that does not is ended, and at fault.
int wait_for(pid_t child)
{
    const auto start = Clock::now();
    for (int status = 0;;) {
        if (waitpid(child, &status, WNOHANG) == child) return status;
        if (std::chrono::duration<double>(Clock::now() - start).count() > kMostSeconds) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            fault("it goes on after its time");
        }
        usleep(200);
    }
}

std::string text_of(int descriptor)
{
    constexpr off_t kMost = 1 << 16;
    std::string text(static_cast<std::size_t>(std::min(lseek(descriptor, 0, SEEK_END), kMost)), '\0');
    text.resize(
        static_cast<std::size_t>(std::max<ssize_t>(0, pread(descriptor, text.data(), text.size(), 0))));
    return text;
}

void run_recipe(const World& world, Ends& ends)
{
    const int errors = memfd_create("errors", 0);
    const pid_t child = fork();
    if (errors < 0 || child < 0) fault("no child process");
    if (child == 0) run_child(world, errors);
    const int status = wait_for(child);
    const std::string& said = ends.said = text_of(errors);
    close(errors);
    ++ends.runs;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        ++ends.done;
    else if (WIFEXITED(status) && WEXITSTATUS(status) == 1)
        ++ends.raised;
    else
        fault((WIFSIGNALED(status) ? std::string("ended by ") + strsignal(WTERMSIG(status))
                                   : "exit code " + std::to_string(WEXITSTATUS(status))) +
              "\n" + said);
    constexpr std::string_view kBegins = "lacuna: ";
    if (WEXITSTATUS(status) == 1 && said.find(kBegins) == said.npos) fault("it failed and did not say why");
    for (const char* const sign : {"unknown error inside", "basic_string", "vector::", "std::"})
        if (said.find(sign) != said.npos && recipe.find(sign) == recipe.npos)
            fault("an exception's bare text: " + said);
    world.check_outside();
}

// The first byte says what the others are.
constexpr char kDamaged = 2; // below it: choices alone
constexpr char kAsItIs = 3;

std::string make_recipe(std::string_view bytes, const World& world)
{
    std::string text;
    Choices choices(bytes);
    const std::size_t kind = choices.below(kAsItIs + 1);
    if (kind == kAsItIs) return std::string(bytes.substr(std::min<std::size_t>(1, bytes.size())));
    expand("recipe", choices, 0, text);
    for (std::size_t k = kind == kDamaged ? 1 + choices.below(8) : 0; k > 0; --k) damage(text, choices);
    for (std::size_t at; (at = text.find("HOME/")) != text.npos;) text.replace(at, 4, world.home().string());
    return text;
}

Ends ends;

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static World world;
    constexpr std::uint64_t kRunsOfFolder = 64; // then the output is taken away
    recipe = make_recipe({reinterpret_cast<const char*>(data), size}, world);
    run_recipe(world, ends);
    if (ends.runs % kRunsOfFolder == 0) world.clear_output();
    return 0;
}

#ifndef LACUNA_FUZZ

int main(int argc, char** argv)
{
    constexpr std::size_t kMostBytes = 400; // choices of a recipe
    std::uint64_t runs = UINT64_MAX, seed = 1;
    double seconds = 1e9;
    bool shows = false;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] { return i + 1 < argc ? argv[++i] : "0"; };
        if (word == "--show")
            shows = true;
        else if (word == "--runs")
            runs = std::strtoull(value(), nullptr, 10);
        else if (word == "--seconds")
            seconds = std::strtod(value(), nullptr);
        else if (word == "--seed")
            seed = std::strtoull(value(), nullptr, 10);
        else
            files.push_back(word);
    }
    const auto run = [&](const std::string& bytes) {
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
        if (shows)
            std::fprintf(stderr, "--- run %llu\n%s\n--> %s\n", static_cast<unsigned long long>(ends.runs),
                         recipe.c_str(), ends.said.c_str());
    };
    for (const std::string& file : files) { // as they are
        std::ifstream in(file, std::ios::binary);
        run(std::string(1, kAsItIs) + std::string(std::istreambuf_iterator<char>(in), {}));
    }
    std::mt19937_64 dice(seed);
    const auto start = Clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    while (files.empty() && ends.runs < runs && passed() < seconds) {
        std::string bytes(1 + dice() % kMostBytes, '\0');
        for (char& byte : bytes) byte = static_cast<char>(dice());
        bytes[0] = static_cast<char>(dice() % kAsItIs); // text out of dice is no recipe
        run(bytes);
    }
    std::printf("%llu recipes, %.1f s: %llu ended well, %llu with an error\n",
                static_cast<unsigned long long>(ends.runs), passed(),
                static_cast<unsigned long long>(ends.done), static_cast<unsigned long long>(ends.raised));
}

#endif
