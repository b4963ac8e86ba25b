// SPDX-License-Identifier: MIT
#include "support/blocks.h"
#include "support/folder.h"

#include <lacuna/core/shared/parallel.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/io/whole_file.h>

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace lacuna;

TEST_CASE("a file appears when it is whole and not before")
{
    const test::Folder folder;
    const std::string path = folder.file("a.txt");
    {
        io::WholeFile file(path);
        file.append("one ");
        file.append("two");
        CHECK_FALSE(std::filesystem::exists(path));
        file.commit();
        CHECK(test::bytes_of(path) == "one two");
    }
    CHECK(folder.entries() == 1);
}

TEST_CASE("a file that is given up leaves nothing, and what was there before stays")
{
    const test::Folder folder;
    const std::string path = folder.file("a.txt");
    test::put_bytes(path, "before");
    {
        io::WholeFile file(path);
        file.append("half");
    }
    CHECK(test::bytes_of(path) == "before");
    CHECK(folder.entries() == 1);
}

TEST_CASE("room that was taken before is filled in any order")
{
    const test::Folder folder;
    const std::string path = folder.file("a.txt");
    {
        io::WholeFile file(path);
        file.reserve(0, 4);
        file.reserve(4, 10);
        file.write_at(7, "two");
        file.write_at(0, "one and");
        CHECK_FALSE(std::filesystem::exists(path));
        file.commit();
    }
    CHECK(test::bytes_of(path) == "one andtwo");
}

TEST_CASE("a file that does not stay in the system's memory has the same bytes, by one thread and by two")
{
    const test::Folder folder;
    std::string whole(3'000'000, ' ');
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = static_cast<char>((i * i) >> 3);
    for (const std::size_t cached : {0, 1'000'000, 5'000'000}) {
        for (const bool reserved : {true, false}) {
            for (const int threads : {1, 2}) {
                CAPTURE(cached);
                const std::string path = folder.file("a.bin");
                io::WholeFile file(path);
                file.cache_up_to(cached);
                if (reserved) file.reserve(0, whole.size());
                RunContext context;
                context.threads = threads;
                constexpr std::size_t kPiece = 70'001; // pieces meet within pages
                parallel_for(context, (whole.size() + kPiece - 1) / kPiece, 1,
                             [&](std::size_t begin, std::size_t end) {
                                 for (std::size_t p = begin; p < end; ++p)
                                     file.write_at(p * kPiece,
                                                   std::string_view(whole).substr(p * kPiece, kPiece));
                             });
                file.commit();
                CHECK(test::bytes_of(path) == whole);
            }
        }
    }
}

TEST_CASE("places that cannot be written to are told apart")
{
    const test::Folder folder;
    const auto code = [](const std::string& path) {
        return test::error_code([&] { io::WholeFile file(path); });
    };
    CHECK(code("") == "io.no_path");
    CHECK(code(folder.file("missing/a.msh")) == "io.no_folder");
    CHECK(code(folder.file("")) == "io.not_a_file");
    CHECK(code(folder.file(".")) == "io.not_a_file");
    CHECK(code("/dev/null") == "io.not_a_file");
    test::put_bytes(folder.file("plain"), "x");
    CHECK(code(folder.file("plain/a.msh")) == "io.no_folder");
    CHECK(code(folder.file(std::string(300, 'n'))) == "io.write_failed");

    std::string message;
    try {
        io::write_msh(test::block({}), folder.file("missing/a.msh"));
    } catch (const InvalidInput& error) {
        message = error.what();
    }
    CHECK(message.find(folder.file("missing")) != std::string::npos);
}

TEST_CASE("a link to a file stays a link, and the file behind it is replaced")
{
    const test::Folder folder;
    test::put_bytes(folder.file("target"), "before");
    std::filesystem::create_symlink("target", folder.file("link"));
    io::WholeFile file(folder.file("link"));
    file.append("after");
    file.commit();
    CHECK(std::filesystem::is_symlink(folder.file("link")));
    CHECK(test::bytes_of(folder.file("target")) == "after");
}

TEST_CASE("a disk that is full ends the writing with an error and leaves nothing behind")
{
    // A limit on the size of files, in a process of its own, stands for the disk.
    const auto mesh = test::block({.columns = 40, .rows = 40, .layers = 20});
    for (const bool binary : {true, false}) {
        const test::Folder folder;
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{1 << 20, 1 << 20};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            int status = 1;
            try {
                io::write_msh(mesh, folder.file("a.msh"), {.binary = binary});
            } catch (const BackendError& error) {
                status = error.code() == "io.write_failed" ? 0 : 2;
            } catch (...) {
                status = 3;
            }
            ::_exit(status);
        }
        int status = -1;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
        CHECK(folder.entries() == 0);
    }
}

TEST_CASE("a cancelled writing leaves what was there before and nothing else")
{
    const test::Folder folder;
    test::put_bytes(folder.file("a.msh"), "before");
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    for (const bool binary : {true, false}) {
        CHECK_THROWS_AS(io::write_msh(test::block({}), folder.file("a.msh"), {.binary = binary}, context),
                        Cancelled);
        CHECK(test::bytes_of(folder.file("a.msh")) == "before");
        CHECK(folder.entries() == 1);
    }
}

TEST_CASE("a file that is replaced keeps its mode")
{
    const test::Folder folder;
    const std::string path = folder.file("a.txt");
    for (const mode_t mode : {0640, 0600, 0444, 0755}) {
        test::put_bytes(path, "before");
        REQUIRE(::chmod(path.c_str(), mode) == 0);
        io::WholeFile file(path);
        file.append("after");
        file.commit();
        struct stat status = {};
        REQUIRE(::stat(path.c_str(), &status) == 0);
        CHECK((status.st_mode & 07777) == mode);
        CHECK(test::bytes_of(path) == "after");
        std::filesystem::remove(path);
    }
}

TEST_CASE("a process that is killed while it writes leaves nothing")
{
    const test::Folder folder;
    test::put_bytes(folder.file("a.txt"), "before");
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        io::WholeFile file(folder.file("a.txt"));
        io::WholeFile fresh(folder.file("b.txt"));
        file.append("half");
        fresh.append("half");
        ::raise(SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(test::bytes_of(folder.file("a.txt")) == "before");
    CHECK(folder.entries() == 1);
}

TEST_CASE("what a killed process left under a name goes once it is old, and nothing else does")
{
    const test::Folder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        io::WholeFile file(folder.file("a.txt"), io::WholeFile::Naming::named);
        ::raise(SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(folder.entries() == 1);
    const std::string left = folder.file(".a.txt.unfinished-" + std::to_string(child) + "-0");
    REQUIRE(std::filesystem::exists(left));
    const std::string running = folder.file(".a.txt.unfinished-" + std::to_string(::getpid()) + "-7");
    const std::string other = folder.file(".b.txt.unfinished-" + std::to_string(child) + "-0");
    const std::string word = folder.file(".a.txt.unfinished-" + std::to_string(child) + "x");
    for (const std::string& path : {running, other, word}) test::put_bytes(path, "");
    const auto write = [&] {
        io::WholeFile file(folder.file("a.txt"), io::WholeFile::Naming::named);
        file.commit();
    };
    write();
    CHECK(std::filesystem::exists(left)); // it may be written on another machine
    const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(2);
    for (const std::string& path : {left, running, other, word}) std::filesystem::last_write_time(path, old);
    write();
    CHECK(!std::filesystem::exists(left));
    for (const std::string& path : {running, other, word}) CHECK(std::filesystem::exists(path));
}

TEST_CASE("what a kill left while a file was replaced goes with the next replacing, whatever number it bears")
{
    const test::Folder folder;
    const std::string other = folder.file(".b.txt.replacing-1-0");
    const std::string word = folder.file(".a.txt.replacing-1x");
    const std::string begin = folder.file(".a.txt.replacing-");
    // Numbers of processes come again: in a container they are often the same.
    const std::string mine = begin + std::to_string(::getpid()) + "-3";
    const std::string held = begin + "1-1";
    for (const std::string& left : {begin + "1-0", mine, held, other, word}) test::put_bytes(left, "whole");
    test::put_bytes(folder.file("a.txt"), "before");
    const int writer = ::open(held.c_str(), O_RDONLY | O_CLOEXEC);
    REQUIRE(writer >= 0);
    REQUIRE(::flock(writer, LOCK_EX | LOCK_NB) == 0);
    const auto replace = [&] {
        io::WholeFile file(folder.file("a.txt"));
        file.append("after");
        file.commit();
    };
    replace();
    CHECK(test::bytes_of(folder.file("a.txt")) == "after");
    for (const std::string& path : {held, other, word}) CHECK(std::filesystem::exists(path));
    CHECK(folder.entries() == 4);
    ::close(writer); // as a kill does
    replace();
    CHECK(!std::filesystem::exists(held));
    CHECK(folder.entries() == 3);
}

TEST_CASE("many that replace one file at once leave one whole file")
{
    const test::Folder folder;
    constexpr int kThreads = 4, kTimes = 50;
    const auto write = [&](char letter) {
        for (int i = 0; i < kTimes; ++i) {
            io::WholeFile file(folder.file("a.txt"));
            file.append(std::string(1000, letter));
            file.commit();
        }
    };
    std::array<std::string, kThreads> errors;
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
        threads.emplace_back([&, t] {
            const char letter = static_cast<char>('a' + t);
            errors[t] = test::error_code([&] { write(letter); });
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& error : errors) CHECK(error.empty());
    const std::string bytes = test::bytes_of(folder.file("a.txt"));
    REQUIRE(bytes.size() == 1000);
    CHECK(bytes == std::string(1000, bytes.front()));
    CHECK(folder.entries() == 1);
}

TEST_CASE("below a folder that is held, no path leads out of it")
{
    const test::Folder folder;
    const test::Folder elsewhere;
    std::filesystem::create_directory(folder.file("deeper"));
    std::filesystem::create_symlink(elsewhere.file(""), folder.file("door"));
    std::filesystem::create_symlink(elsewhere.file("x"), folder.file("file"));
    const auto held = std::make_shared<const io::Folder>(folder.file(""));
    const auto write = [&](const std::string& path) {
        return test::error_code([&] {
            io::WholeFile file(io::OutputPath::below(held, path));
            file.append("x");
            file.commit();
        });
    };
    CHECK(write("../x") == "io.outside");
    CHECK(write("deeper/../../x") == "io.outside");
    CHECK(write("/tmp/x") == "io.outside");
    CHECK(write(elsewhere.file("x")) == "io.outside");
    CHECK(write("door/x") == "io.outside");
    CHECK(write("file") == "io.not_a_file");
    CHECK(write("nowhere/x") == "io.no_folder");
    CHECK(write("deeper") == "io.not_a_file");
    CHECK(elsewhere.entries() == 0);
    CHECK(write("x") == "");
    CHECK(write("deeper/y") == "");
    CHECK(write(folder.file("deeper/z")) == "");
    CHECK(test::bytes_of(folder.file("deeper/z")) == "x");

    // The folder is the one that was opened, whatever takes its path.
    std::filesystem::rename(folder.file("deeper"), folder.file("moved"));
    CHECK(std::filesystem::exists(folder.file("moved/y")));
}
