// SPDX-License-Identifier: GPL-2.0-or-later
// What becomes of the CAD process, and what the host gets to know of it.
#include "made_files.h"
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/whole_families.h"

#include <lacuna/cad/detail/worker.h>
#include <lacuna/cad/write_cad.h>
#include <lacuna/cad_worker/confine.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace lacuna;
using namespace cad_protocol;
namespace occ = gmsh::model::occ;
namespace fs = std::filesystem;

namespace {

/// "code: message" of the error that work gives.
template <class Work>
std::string failure(Work&& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error.code() + ": " + error.what();
    }
    return "no error";
}

using test::has;

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A script that works for hours.
std::string endless(const test::TempFolder& folder)
{
    return folder.write("endless.geo", "Point(1) = {0, 0, 0};\nFor i In {1:2000000000}\n  x = i;\nEndFor\n");
}

/// Have the CAD process read a script no one looked through.
std::string run_unseen(const std::string& text)
{
    const Descriptor file(::memfd_create("script", MFD_CLOEXEC));
    REQUIRE(::write(file.get(), text.data(), text.size()) == ssize_t(text.size()));
    LoadRequest request;
    request.files.push_back({LoadFile::script, "unseen.geo", {{"unseen.geo"}}});
    return failure([&] {
        (void)cad::Worker::current()->ask<LoadReply>(Opcode::load, request, {"unseen.geo", "reading it"},
                                                     {file.get()});
    });
}

/// Another program in place of the CAD process, which misbehaves as told.
class Fake {
public:
    explicit Fake(const std::string& how) : program_(std::getenv("LACUNA_CAD"))
    {
        ::setenv("LACUNA_CAD", LACUNA_FAKE_WORKER, 1);
        ::setenv("CSF_FAKE", how.c_str(), 1);
        end_current();
    }
    ~Fake()
    {
        ::setenv("LACUNA_CAD", program_.c_str(), 1);
        ::unsetenv("CSF_FAKE");
        end_current();
    }
    Fake(const Fake&) = delete;
    Fake& operator=(const Fake&) = delete;

private:
    static void end_current()
    {
        try {
            test::kill_worker();
        } catch (const Error&) { // There was none, and none would start.
        }
    }
    std::string program_;
};

/// Of each system call that the filter names, the verdicts it can get; read from the filter's own text.
std::map<std::string, std::set<std::string>> filter_rows()
{
    const Descriptor file(::memfd_create("filter", MFD_CLOEXEC));
    REQUIRE(cad_worker::write_filter(file.get()));
    std::string text(static_cast<std::size_t>(::lseek(file.get(), 0, SEEK_END)), '\0');
    REQUIRE(::pread(file.get(), text.data(), text.size(), 0) == ssize_t(text.size()));
    std::map<std::string, std::set<std::string>> rows;
    std::string line, call;
    for (std::istringstream lines(text); std::getline(lines, line);) {
        if (line.find("# default action") != std::string::npos) call = "default";
        if (line.find("# invalid architecture action") != std::string::npos) call = "machine";
        if (const std::size_t at = line.find("# filter for syscall \""); at != std::string::npos) {
            const std::size_t from = line.find('"') + 1;
            call = line.substr(from, line.find('"', from) - from);
        }
        if (const std::size_t at = line.find("action "); at != std::string::npos && line.back() == ';')
            rows[call].insert(line.substr(at + 7, line.size() - at - 8));
    }
    return rows;
}

} // namespace

TEST_CASE("the filter names every system call that reading and writing CAD needs, and no other")
{
    std::map<std::string, std::set<std::string>> wanted{
        {"default", {"ERRNO(1)"}},        {"machine", {"KILL_PROCESS"}},
        {"openat", {"ALLOW", "TRAP"}},    {"newfstatat", {"ALLOW", "TRAP"}},
        {"faccessat", {"ALLOW", "TRAP"}}, {"faccessat2", {"TRAP"}},
        {"clone3", {"ERRNO(38)"}},        {"rt_sigaction", {"ALLOW", "ERRNO(0)"}},
    };
    for (const char* call : {"clone",
                             "tgkill",
                             "prlimit64",
                             "ioctl",
                             "prctl",
                             "read",
                             "write",
                             "readv",
                             "writev",
                             "pread64",
                             "pwrite64",
                             "lseek",
                             "close",
                             "fstat",
                             "ftruncate",
                             "dup",
                             "fcntl",
                             "mmap",
                             "munmap",
                             "mprotect",
                             "mremap",
                             "madvise",
                             "brk",
                             "rt_sigprocmask",
                             "rt_sigreturn",
                             "sigaltstack",
                             "futex",
                             "sched_yield",
                             "sched_getaffinity",
                             "getpid",
                             "gettid",
                             "getppid",
                             "getuid",
                             "geteuid",
                             "getgid",
                             "getegid",
                             "getrusage",
                             "times",
                             "clock_gettime",
                             "clock_getres",
                             "gettimeofday",
                             "nanosleep",
                             "clock_nanosleep",
                             "ppoll",
                             "pselect6",
                             "sendmsg",
                             "recvmsg",
                             "exit",
                             "exit_group",
                             "set_robust_list",
                             "getrandom",
                             "uname",
                             "sysinfo",
                             "set_tid_address",
                             "membarrier",
                             "getcwd",
                             "readlinkat",
                             "getdents64",
                             "rt_sigtimedwait",
                             "restart_syscall",
                             "getcpu",
                             "rseq"})
        wanted[call] = {"ALLOW"};
#if defined(__x86_64__)
    for (const char* call : {"poll", "select", "time", "arch_prctl"}) wanted[call] = {"ALLOW"};
    for (const char* call : {"open", "stat", "lstat", "access"}) wanted[call] = {"TRAP"};
#endif
    CHECK(filter_rows() == wanted);
}

TEST_CASE("a CAD process killed between calls costs its models nothing while their files stay as they are")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); });
    const topology::Model model = cad::load({path});
    const pid_t first = cad::Worker::current()->pid();
    test::kill_worker();
    std::vector<Vec3> points{{1, 0, 0}};
    std::vector<Vec2> uv{{0, 0}};
    const auto project = [&] {
        points.assign(1, {2, 0, 0});
        model.faces[0].surface->project(points, uv);
    };
    CHECK(failure(project) == "no error");
    CHECK(points[0].norm() == doctest::Approx(1));
    CHECK(cad::Worker::current()->pid() != first);

    test::kill_worker();
    std::ofstream(path, std::ios::app) << "\n";
    for (int i = 0; i < 2; ++i) {
        const std::string words = failure(project);
        CHECK(has(words, "cad.file_changed"));
        CHECK(has(words, path + " has changed"));
        CHECK(has(words, "call lacuna.load again"));
    }
    fs::remove(path);
    CHECK(has(failure(project), "cad.file_changed"));
    CHECK(has(failure(project), path));
}

TEST_CASE("of several models that a CAD process held, only the one it ended over gets an error")
{
    const test::TempFolder folder;
    const topology::Model ball = cad::load({folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); })});
    const topology::Model other = cad::load({folder.gmsh("other.step", [] { occ::addSphere(0, 0, 0, 2); })},
                                            {.scale = 3});
    CHECK(has(failure([&] { (void)cad::load({endless(folder)}, {}, {}, {.seconds = 0.5}); }),
              "cad.time_limit"));
    for (const auto& [model, radius] : {std::pair(&ball, 1.0), std::pair(&other, 6.0)}) {
        std::vector<Vec3> points{{1.1 * radius, 0, 0}};
        std::vector<Vec2> uv{{0, 0}};
        CHECK(failure([&] { model->faces[0].surface->project(points, uv); }) == "no error");
        CHECK(points[0].norm() == doctest::Approx(radius));
    }
}

TEST_CASE("cancelling a long projection stops within half a second, and the model stays whole")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); })});
    std::vector<Vec3> points(2'000'000, Vec3(1.1, 0.2, 0.1));
    std::vector<Vec2> uv(points.size(), Vec2(0.1, 0.1));
    for (const int wait : {20, 200, 500}) {
        const auto seconds = test::stops_within(
            std::chrono::milliseconds(wait),
            [&](const RunContext& context) { model.faces[0].surface->project(points, uv, context); });
        REQUIRE(seconds);
        CHECK(*seconds < 0.5);
    }
    points.assign(1, {1.1, 0, 0});
    uv.assign(1, {0, 0});
    CHECK(failure([&] { model.faces[0].surface->project(points, uv); }) == "no error");
}

TEST_CASE("a CAD process that dies, stops or works for ever ends alone, and the error says how")
{
    const test::TempFolder folder;
    const std::string path = endless(folder);
    const std::string box = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    for (const int signal : {SIGKILL, SIGSEGV, SIGABRT, SIGFPE}) {
        const pid_t pid = cad::Worker::current()->pid();
        std::thread killer([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            ::kill(pid, signal);
        });
        const std::string words = failure([&] { (void)cad::load({path}); });
        killer.join();
        CHECK(has(words, "cad.worker_ended"));
        CHECK(has(words, path));
        CHECK(has(words, std::string("SIG") + ::sigabbrev_np(signal)));
        CHECK(cad::load({box}).faces.size() == 6);
    }
    for (const bool stopped : {false, true}) {
        if (stopped) ::kill(cad::Worker::current()->pid(), SIGSTOP);
        const auto start = std::chrono::steady_clock::now();
        const std::string words = failure([&] { (void)cad::load({path}, {}, {}, {.seconds = 0.5}); });
        CHECK(has(words, "cad.time_limit"));
        CHECK(has(words, "0.5 s"));
        CHECK(has(words, path));
        CHECK(seconds_since(start) < 5);
        CHECK(cad::load({box}).faces.size() == 6);
    }
}

TEST_CASE("a file that takes too much memory is an error that says so")
{
    const test::TempFolder folder;
    const std::string path = folder.write("much.geo", "a[] = {1:2000000000};\n");
    const std::string words = failure([&] { (void)cad::load({path}, {}, {}, {.memory = 1'500'000'000}); });
    CHECK((has(words, "cad.memory_limit") || has(words, "cad.worker_ended")));
    CHECK(has(words, path));
    CHECK(cad::load({folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); })}).faces.size() == 6);
}

TEST_CASE("limits that may not raise only lower what a request may take")
{
    const test::TempFolder folder;
    const std::string path = endless(folder);
    ::setenv("LACUNA_CAD_SECONDS", "0.3", 1);
    for (const double seconds : {0.2, 0.3, 1000.0}) {
        const auto start = std::chrono::steady_clock::now();
        const std::string words = failure(
            [&] { (void)cad::load({path}, {}, {}, {.seconds = seconds, .may_raise = false}); });
        CHECK(has(words, "cad.time_limit"));
        CHECK(has(words, seconds < 0.3 ? "0.2 s" : "0.3 s"));
        CHECK(seconds_since(start) < 10);
    }
    ::unsetenv("LACUNA_CAD_SECONDS");
}

TEST_CASE("cancelling ends the CAD process within half a second")
{
    const test::TempFolder folder;
    std::atomic<bool> cancel = false;
    RunContext context;
    context.cancel = &cancel;
    std::chrono::steady_clock::time_point asked;
    (void)cad::gmsh_version();
    std::thread canceller([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        asked = std::chrono::steady_clock::now();
        cancel = true;
    });
    CHECK_THROWS_AS(cad::load({endless(folder)}, {}, context), Cancelled);
    canceller.join();
    CHECK(seconds_since(asked) < 0.5);
}

TEST_CASE("a script that asks for more than geometry is refused, with the line")
{
    const test::TempFolder folder;
    const std::string made = folder.path("made.txt");
    folder.write("one.geo", "Point(9) = {0, 0, 0};\n");
    fs::create_directory(folder.path("other"));
    folder.write("other/two.geo", "Point(8) = {0, 0, 0};\n");
    for (const std::string& line :
         {"SystemCall \"touch " + made + "\";", "NonBlockingSystemCall \"touch " + made + "\";",
          std::string("If (1 > 0) Exit; EndIf"), "Save \"" + made + "\"",
          std::string("Include \"other/two.geo\";"), std::string("Merge \"/etc/passwd\";"),
          std::string("Merge \"../x.step\";"), std::string("Merge Str(\"a\", \"b\");"),
          std::string("Include \"absent.geo\";")}) {
        CAPTURE(line);
        const std::string path = folder.write("asks.geo", "Point(1) = {0, 0, 0}; /* Save\n*/ " + line + "\n");
        const std::string words = failure([&] { (void)cad::load({path}); });
        CHECK(has(words, "cad.script: "));
        CHECK(has(words, path + ", line 2"));
        CHECK(!fs::exists(made));
    }
    // An included script is looked through as well.
    folder.write("asking.geo", "\n\nSystemCall \"touch " + made + "\";\n");
    const std::string words = failure(
        [&] { (void)cad::load({folder.write("in.geo", "Include \"asking.geo\";\n")}); });
    CHECK(has(words, folder.path("asking.geo") + ", line 3"));
    folder.write("ending.geo", "Point(3) = {0, 0, 0};\nExit;\n");
    CHECK(has(failure([&] { (void)cad::load({folder.write("in.geo", "Include \"ending.geo\";\n")}); }),
              folder.path("ending.geo") + ", line 2"));
}

TEST_CASE("nothing of a script behind Exit is run or looked at")
{
    const test::TempFolder folder;
    const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\n";
    const double area = test::total_area(cad::load({folder.write("plain.geo", box)}));
    for (const std::string before : {"", "If (1 > 2) Point(9) = {0, 0, 0}; EndIf\n",
                                     "For i In {1 : 2}\n  x~{i} = i;\nEndFor\n", "Exiting = 1; // Exit;\n"}) {
        for (const std::string behind : {"", "Box(2) = {5, 0, 0, 1, 1, 1};\n", "SystemCall \"ls\";\n",
                                         "Include \"absent.geo\";\n", "this is no command\n", "Exit;\n"}) {
            CAPTURE(before);
            CAPTURE(behind);
            const std::string path = folder.write("exits.geo", box + before + "Exit;\n" + behind);
            CHECK(test::total_area(cad::load({path})) == doctest::Approx(area));
        }
    }
}

TEST_CASE("commands of a script that write files, run plugins or mesh are skipped with a note, not run")
{
    const test::TempFolder folder;
    const std::string made = folder.path("made");
    const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\n";
    const double area = test::total_area(cad::load({folder.write("plain.geo", box)}));
    for (const std::string& line :
         {"Save \"" + made + "\";",
          "Save Sprintf(\"" + made + "%g\", 1);",
          "Print \"" + made + "\";",
          "Print Str(\"" + made + "\");",
          "Printf(\"x\") > \"" + made + "\";",
          "Printf(\"%g > 1; x\", (1 > 2)) >> \"" + made + "\";",
          "CreateFile \"" + made + "\";",
          std::string("Plugin(Warp).Run;"),
          std::string("Plugin(Triangulate).View = 0;"),
          std::string("Mesh 3;"),
          std::string("Mesh(2);"),
          std::string("Mesh\n2\n;"),
          std::string("dim = 3; Mesh dim;"),
          std::string("RefineMesh;"),
          std::string("OptimizeMesh \"Netgen\";"),
          std::string("SetOrder 2;"),
          std::string("PartitionMesh 4;"),
          std::string("RenumberMeshNodes;"),
          std::string("RecombineMesh;"),
          std::string("AdaptMesh { 1 } { 2 } { { 3 } };"),
          std::string("RelocateMesh Surface { 1 };"),
          std::string("If (1 > 0) Save \"x;y\"; EndIf"),
          std::string("For i In {1 : 3}\n  Mesh i; // first\n  Save /* where; */ \"a.msh\";\nEndFor")}) {
        CAPTURE(line);
        const std::string path = folder.write("skips.geo",
                                              box + line + "\nPhysical Surface(\"all\") = {1 : 6};\n");
        std::vector<std::string> told;
        RunContext context;
        context.log = [&](std::string_view text) { told.emplace_back(text); };
        const topology::Model model = cad::load({path}, {}, context);
        CHECK(test::total_area(model) == doctest::Approx(area));
        CHECK(model.faces[0].name == "all"); // what follows is read
        const std::string begin = "note: " + path +
                                  ": only the geometry of the script is read. Skipped commands: ";
        CHECK(std::ranges::count_if(told, [&](const std::string& text) { return text.starts_with(begin); }) ==
              1);
        CHECK(!fs::exists(made));
        CHECK(!fs::exists(made + "1"));
        // An included script is looked through as well.
        folder.write("inner.geo", line + "\n");
        const topology::Model outer = cad::load(
            {folder.write("outer.geo", box + "Include \"inner.geo\";\n")});
        CHECK(test::total_area(outer) == doctest::Approx(area));
        REQUIRE(outer.notes.size() == 1);
        CHECK(has(outer.notes[0].text(), folder.path("inner.geo")));
    }
    // Words that are no commands there stay: options, variables, texts, groups.
    const std::string words = "Mesh.MshFileVersion = 2.2;\nPrint.Background = 1;\nSave = 2;\n" + box +
                              "Box(2) = {5, 0, 0, Save, 1, 1};\nPhysical Volume(\"Mesh\") = {1};\n"
                              "Printf(\"Mesh 3; Save\");\n";
    const topology::Model model = cad::load({folder.write("words.geo", words)});
    CHECK(test::total_area(model) == doctest::Approx(area + 10));
    CHECK(model.notes.empty());
}

TEST_CASE("a script may include and merge what lies beside it")
{
    const test::TempFolder folder;
    folder.gmsh("ball.step", [] { occ::addSphere(5, 0, 0, 1); });
    folder.write("size.geo", "w = 2; // SystemCall in a comment\n");
    const std::string path = folder.write("main.geo", "Include \"size.geo\";\nSetFactory(\"OpenCASCADE\");\n"
                                                      "Printf(\"Save me\");\nMerge \"ball.step\";\n"
                                                      "Box(100) = {0, 0, 0, w, 1, 1};\n");
    const topology::Model model = cad::load({path});
    CHECK(model.faces.size() == 7);
    CHECK(test::total_area(model) == doctest::Approx(10 + 4 * 3.14159265).epsilon(0.01));
}

TEST_CASE(
    "the CAD process starts nothing, writes nothing and reads nothing it was not given, whatever it is told")
{
    const test::TempFolder folder;
    const std::string made = folder.path("made.txt");
    const std::string secret = folder.write("secret.geo", "Printf(\"x\");\nnonsense;\n");
    (void)run_unseen("SystemCall \"touch " + made + "\";\n");
    (void)run_unseen("NonBlockingSystemCall \"touch " + made + "\";\n");
    (void)run_unseen("Printf(\"x\") > \"" + made + "\";\n");
    (void)run_unseen("SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0,1,1,1}; Save \"" +
                     folder.path("made.brep") + "\";\n");
    CHECK(!fs::exists(made));
    CHECK(!fs::exists(folder.path("made.brep")));
    if (!has(cad::gmsh_version(), "without Landlock")) {
        const std::string words = run_unseen("Merge \"" + secret + "\";\n");
        CHECK(!has(words, "line 2"));
    }
    CHECK(has(run_unseen("Exit;\n"), "cad.worker_ended"));
}

TEST_CASE("no options file beside a CAD file is read, and no ending is believed against the content")
{
    const test::TempFolder folder;
    const std::string made = folder.path("made.txt");
    const std::string box = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    folder.write("box.step.opt", "SystemCall \"touch " + made + "\";\n");
    CHECK(cad::load({box}).faces.size() == 6);
    for (const char* name : {"p.Geo", "p.step", "p.Brep", "p.igs"}) {
        const std::string path = folder.write(name, "SystemCall \"touch " + made + "\";\n");
        CHECK(has(failure([&] { (void)cad::load({path}); }), "cad.unreadable"));
    }
    fs::copy_file(box, folder.path("box.geo"));
    CHECK(has(failure([&] { (void)cad::load({folder.path("box.geo")}); }), "cad.unreadable"));
    CHECK(!fs::exists(made));
    REQUIRE(::mkfifo(folder.path("pipe.step").c_str(), 0600) == 0);
    CHECK(has(failure([&] { (void)cad::load({folder.path("pipe.step")}); }), folder.path("pipe.step")));
}

TEST_CASE("a CAD process that lies does no harm")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    for (const std::string how : {"ends", "garbage", "version"}) {
        CAPTURE(how);
        const Fake fake(how);
        const std::string words = failure([&] { (void)cad::load({path}); });
        CHECK(has(words, "cad.no_worker"));
        CHECK(has(words, path));
    }
    for (const std::string how :
         {"length", "opcode", "descriptors", "indices", "edges", "form", "solids", "nan", "text", "half"}) {
        CAPTURE(how);
        const Fake fake(how);
        const std::string words = failure([&] { (void)cad::load({path}); });
        CHECK((has(words, "cad.protocol") || has(words, "cad.worker_ended")));
        CHECK(has(words, path));
    }
    for (const std::string how : {"silent", "deaf"}) {
        CAPTURE(how);
        const Fake fake(how);
        CHECK(has(failure([&] { (void)cad::load({path}, {}, {}, {.seconds = 0.5}); }), "cad.time_limit"));
    }
    {
        const Fake fake("noise"); // replies with bytes changed, another way every time
        test::MembersToRun run(11);
        for (int i = 0; i < 300; ++i)
            if (run.next()) (void)failure([&] { (void)cad::load({path}); });
    }
    CHECK(cad::load({path}).faces.size() == 6);
}

TEST_CASE("an error of the CAD process names its entities as data")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("box.step", [] { occ::addBox(0, 0, 0, 1, 1, 1); });
    const Fake fake("refuses");
    bool refused = false;
    try {
        (void)cad::load({path});
    } catch (const InvalidInput& error) {
        refused = true;
        const Message& message = error.message();
        CHECK(message.text() == "face 3 \"lid\" of {} has 7 sides, not 8; split edge 4 (vertices 1-2)");
        CHECK(message.code() == "cad.fake");
        CHECK(message.remedy() == "split edge 4 (vertices 1-2)");
        REQUIRE(message.entities() ==
                std::vector<NamedEntity>{{"face", 3}, {"edge", 4}, {"vertex", 1}, {"vertex", 2}});
        CHECK(message.entities()[0].name == "lid");
        CHECK(message.entities()[1].ends == std::pair<long long, long long>(1, 2));
        CHECK(message.found() == std::vector<MessageValue>{7LL});
        CHECK(message.needed() == std::vector<MessageValue>{8LL});
    }
    CHECK(refused);
}

TEST_CASE("the CAD process survives a host that lies")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load(
        {folder.gmsh("ball.step", [] { occ::addSphere(0, 0, 0, 1); })}); // keeps it
    const std::shared_ptr<cad::Worker> worker = cad::Worker::current();
    const cad::Task task{"nothing", "lying"};
    const auto ask = [&](Opcode opcode, const auto& request) {
        return failure([&] { (void)worker->ask<EvaluateReply>(opcode, request, task); });
    };
    CHECK(has(ask(Opcode::evaluate, EvaluateRequest{77, 1, {0.5}}), "model number is unknown"));
    CHECK(has(ask(Opcode::project, ProjectRequest{1, 77, {Vec3(0, 0, 0)}, {Vec2(0, 0)}}), "cad"));
    CHECK(has(ask(Opcode::project, ProjectRequest{1, 1, {Vec3(0, 0, 0)}, {}}), "cad.protocol"));
    CHECK(has(ask(Opcode::load, EvaluateRequest{1, 1, {1, 2, 3}}), "cad.protocol"));
    CHECK(has(ask(Opcode(99), ReleaseRequest{1}), "request is unknown"));
    CHECK(has(ask(Opcode::evaluate, EvaluateRequest{1, 4711, {0.5}}), "cad"));
    std::vector<Vec3> points{{1, 0, 0}};
    std::vector<Vec2> uv{{0, 0}};
    CHECK(failure([&] { model.faces[0].surface->project(points, uv); }) == "no error");
    std::mt19937 dice(5);
    for (int i = 0; i < 2000; ++i) {
        LoadRequest request;
        request.files.push_back({LoadFile::step, "x", {{"x"}}});
        std::string bytes = encode(request);
        for (int k = 0; k < 3; ++k) bytes[dice() % bytes.size()] = char(dice());
        (void)failure([&] { (void)decode<LoadRequest>(bytes); });
    }
}

TEST_CASE("damaged CAD files are errors that name the file, or sound readings, and the host lives")
{
    const fs::path hostile = fs::path(test::shared_data()) / "hostile";
    if (!fs::exists(hostile)) {
        MESSAGE("left out: there is no " << hostile.string());
        return;
    }
    std::set<std::string> paths;
    for (const auto& entry : fs::directory_iterator(hostile)) {
        const std::string ending = entry.path().extension();
        if (ending == ".step" || ending == ".iges" || ending == ".brep" || ending == ".geo")
            paths.insert(entry.path());
    }
    std::size_t files = 0, read = 0;
    test::MembersToRun run(9); // some of the files that never end take all the time they may
    for (const std::string& path : paths) {
        if (!run.next()) continue;
        CAPTURE(path);
        ++files;
        const auto start = std::chrono::steady_clock::now();
        const std::string words = failure(
            [&] { test::check_model(cad::load({path}, {}, {}, {.seconds = 2})); });
        CHECK(seconds_since(start) < 20);
        read += words == "no error" ? 1 : 0;
        if (words != "no error") CHECK(has(words, path));
    }
    MESSAGE(files << " files, " << read << " of them read");
}
