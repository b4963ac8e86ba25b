// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/worker.h>

#include <lacuna/cad/detail/worker_program.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/progress.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT(readability-redundant-declaration): not declared by every POSIX system

namespace lacuna::cad {

using namespace cad_protocol;
using Clock = std::chrono::steady_clock;

namespace {

/// Time limit of a request: a constant, plus an amount for each million bytes of files and each thousand
/// points. CAD files of 10 to 86 kB take 0.1 to 1 s. A file that hangs must fail within 20 s.
constexpr double kSeconds = 12, kSecondsPerMegabyte = 100, kSecondsPerThousand = 0.5;
constexpr double kMostSeconds = 3600;
constexpr std::uint64_t kMegabyte = 1'000'000; ///< unit of LACUNA_CAD_MEGABYTES
/// Address space of a request: the libraries take about 0.6 GB, a model of 86 kB less than 0.2 GB.
constexpr std::uint64_t kMemory = std::uint64_t{1792} << 20;
constexpr std::uint64_t kMemoryPerByte = 2000, kMemoryPerPoint = 2000;
/// Bytes of a process's output that an error message quotes.
constexpr std::size_t kLastWords = 300;

double from_environment(const char* name)
{
    const char* text = std::getenv(name);
    if (text == nullptr) return 0;
    const double value = std::strtod(text, nullptr);
    return value > 0 && std::isfinite(value) ? value : 0;
}

double seconds_for(const Task& task)
{
    double seconds = from_environment("LACUNA_CAD_SECONDS");
    if (seconds == 0)
        seconds = std::min(kMostSeconds, kSeconds +
                                             kSecondsPerMegabyte * static_cast<double>(task.bytes) / 1e6 +
                                             kSecondsPerThousand * static_cast<double>(task.points) / 1e3);
    if (task.limits.seconds == 0) return seconds;
    return task.limits.may_raise ? task.limits.seconds : std::min(task.limits.seconds, seconds);
}

/// @param charged  memory for the files and points in the process, besides the constant part [bytes].
std::uint64_t memory_for(const Task& task, std::uint64_t charged)
{
    auto memory = static_cast<std::uint64_t>(from_environment("LACUNA_CAD_MEGABYTES") * kMegabyte);
    if (memory == 0) memory = kMemory + charged;
    if (task.limits.memory == 0) return memory;
    return task.limits.may_raise ? task.limits.memory : std::min(task.limits.memory, memory);
}

/// What the process does, for messages.
MessageParts doing(const Task& task)
{
    return (task.entity ? Message("", "{} {}", task.doing, *task.entity) : Message("", "{}", task.doing))
        .parts();
}

/// Thrown when the time limit is exceeded.
struct TimeOver {};

Clock::time_point after(double seconds)
{
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Limit the elapsed time. After cancelling, wait at most `grace` seconds more.
Channel::Patience patience_of(const RunContext* context, double seconds, double grace = 0)
{
    std::optional<Clock::time_point> cancelled;
    return [context, last = after(seconds), grace, cancelled]() mutable {
        const bool asked = context != nullptr && context->cancel != nullptr &&
                           context->cancel->load(std::memory_order_relaxed);
        if (asked && !cancelled) cancelled = after(grace);
        if (asked && Clock::now() >= *cancelled) throw Cancelled();
        if (Clock::now() > last) throw TimeOver();
    };
}

/// Processor time of a process [s]; 0 if it has ended.
double processor_seconds(pid_t process)
{
    clockid_t clock = {};
    timespec used = {};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// Limit on the elapsed time of a request, as a multiple of the limit on its processor time. The lower limit
/// applies to processor time, so that a good file does not fail on a busy machine. A process that hangs
/// without computing uses no processor time and is stopped by this limit.
constexpr double kWallFactor = 4;

Channel::Patience patience_of(const RunContext* context, double seconds, double grace, pid_t worker)
{
    const double last = processor_seconds(worker) + seconds;
    return [wall = patience_of(context, kWallFactor * seconds, grace), worker, last] {
        wall();
        if (processor_seconds(worker) > last) throw TimeOver();
    };
}

/// Environment variables passed to the CAD process: the library paths, and those of Open CASCADE and the
/// sanitizers. FLTK, which is part of Gmsh, writes preferences to the home folder when it starts, or to /etc
/// if there is no home folder. HOME=/dev/null prevents this.
std::vector<std::string> worker_environment()
{
    std::vector<std::string> kept{"LC_ALL=C", "HOME=/dev/null"};
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        for (const std::string_view name : {"LD_LIBRARY_PATH=", "CSF_", "ASAN_OPTIONS=", "UBSAN_OPTIONS="})
            if (text.starts_with(name)) kept.emplace_back(text);
    }
    return kept;
}

/// Start the program in its own process group, with `socket` as descriptor 3 and its output in `words`.
pid_t spawn(const std::string& program, int socket, int words)
{
    std::vector<std::string> kept = worker_environment();
    std::vector<char*> environment;
    for (std::string& entry : kept) environment.push_back(entry.data());
    environment.push_back(nullptr);
    std::string name = "lacuna-cad";
    std::array<char*, 2> arguments{name.data(), nullptr};

    posix_spawn_file_actions_t files{};
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, words, 1);
    ::posix_spawn_file_actions_adddup2(&files, words, 2);
    ::posix_spawn_file_actions_adddup2(&files, socket, 3);
    posix_spawnattr_t attributes{};
    ::posix_spawnattr_init(&attributes);
    sigset_t all, none;
    ::sigfillset(&all);
    ::sigemptyset(&none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes,
                               POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    pid_t pid = 0;
    const int error = ::posix_spawn(&pid, program.c_str(), &files, &attributes, arguments.data(),
                                    environment.data());
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    if (error != 0)
        throw BackendError(Message("cad.no_worker", "the CAD process {} could not be started: {}", program,
                                   std::strerror(error))
                               .remedy("check the installation of lacuna-cad"));
    return pid;
}

/// Duplicate a descriptor to a number above those that are overwritten in the CAD process.
Descriptor raised(int number)
{
    Descriptor low(number);
    return number > cad_protocol::kSocket
               ? std::move(low)
               : Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, cad_protocol::kSocket + 1));
}

/// The current CAD process of this host; a child made by fork() gets its own. Never destroyed, because static
/// objects of the host may use it at exit.
struct Current {
    pid_t owner = ::getpid();
    std::mutex mutex;
    std::shared_ptr<Worker> worker;
};

Current& current_of_process()
{
    static std::atomic<Current*> known{nullptr};
    Current* current = known.load();
    while (current == nullptr || current->owner != ::getpid()) {
        auto* fresh = new Current;
        if (known.compare_exchange_strong(current, fresh)) return *fresh;
        delete fresh;
    }
    return *current;
}

/// Whether a process has ended. Its exit status can still be read afterwards.
bool has_ended(const Descriptor& process)
{
    siginfo_t info{};
    const auto id = static_cast<id_t>(process.get());
    return ::waitid(P_PIDFD, id, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

} // namespace

std::shared_ptr<Worker> Worker::current(const RunContext* context, const std::string& subject)
{
    Current& current = current_of_process();
    const std::lock_guard lock(current.mutex);
    if (current.worker && !current.worker->spent_) {
        const std::unique_lock busy(current.worker->busy_, std::try_to_lock);
        // A busy process is running. Check an idle one.
        if (busy) current.worker->notice_end();
        if (!busy || !current.worker->ended_) return current.worker;
    }
    current.worker.reset();
    try {
        current.worker = std::shared_ptr<Worker>(new Worker(context));
    } catch (const BackendError& error) {
        throw BackendError(subject.empty() ? error.message() : error.message().about(subject));
    }
    return current.worker;
}

void Worker::notice_end() noexcept
{
    if (!ended_ && has_ended(process_)) end();
}

bool Worker::lives()
{
    if (owner_ != ::getpid()) return false;
    const std::unique_lock lock(busy_, std::try_to_lock);
    if (!lock) return true; // busy, so it is running
    notice_end();
    return !ended_;
}

Worker::Worker(const RunContext* context) : owner_(::getpid())
{
    const std::string program = find_worker_program();
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw BackendError(
            Message("cad.no_worker", "the CAD process does not start: {}", std::strerror(errno))
                .remedy("check the installation of lacuna-cad"));
    Descriptor ours = raised(ends[0]), theirs = raised(ends[1]);
    // Large buffers, so that a large message needs few waits.
    for (const int end : {ours.get(), theirs.get()})
        ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &cad_protocol::kBlock, sizeof(cad_protocol::kBlock));
    words_ = raised(::memfd_create("lacuna-cad words", MFD_CLOEXEC));
    pid_ = spawn(program, theirs.get(), words_.get());
    process_ = Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
    theirs.reset();
    if (!process_) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        throw BackendError(Message("cad.no_worker", "the CAD process needs the system call pidfd_open")
                               .remedy("use a kernel of Linux 5.3 or later"));
    }
    channel_ = std::make_unique<Channel>(std::move(ours));
    const double start_seconds = kWallFactor * kSeconds; // as for a request without data
    try {
        const Frame frame = channel_->receive(patience_of(context, start_seconds));
        if (frame.opcode == Opcode::failed) {
            throw BackendError(Message(decode<Failure>(frame.bytes).message));
        }
        if (frame.opcode != Opcode::hello) throw ProtocolError("it sent no greeting");
        hello_ = decode<Hello>(frame.bytes);
    } catch (const TimeOver&) {
        end();
        throw BackendError(
            Message("cad.no_worker", "{} did not answer within {:.3g} s", program, needed(start_seconds))
                .remedy("check the installation of lacuna-cad"));
    } catch (const ChannelClosed&) {
        end();
        throw BackendError(
            Message("cad.no_worker", "{} ended during start-up ({}{})", program, how_it_ended(), last_words())
                .remedy("check the installation of lacuna-cad"));
    } catch (const ProtocolError& error) {
        end();
        throw BackendError(
            Message("cad.no_worker", "{} is of another version of Lacuna: {} ({}{})", program, error.what(),
                    how_it_ended(), last_words())
                .remedy("install the lacuna-cad of this version, or set LACUNA_CAD to its path"));
    } catch (...) {
        end();
        throw;
    }
}

Worker::~Worker()
{
    if (::getpid() == owner_) end();
}

void Worker::end(std::string why) noexcept
{
    if (!why.empty()) end_ = std::move(why);
    if (ended_) return;
    ended_ = true;
    siginfo_t info{};
    const auto id = static_cast<id_t>(process_.get());
    // If the process has just ended by itself, record its own exit status instead of the kill.
    if (process_ && ::waitid(P_PIDFD, id, &info, WEXITED | WNOHANG) == 0 && info.si_pid == 0) {
        ::syscall(SYS_pidfd_send_signal, process_.get(), SIGKILL, nullptr, 0);
        while (::waitid(P_PIDFD, id, &info, WEXITED) != 0 && errno == EINTR) {}
    }
    status_ = info.si_code == CLD_EXITED ? info.si_status : info.si_code == 0 ? 0 : -info.si_status;
    channel_.reset();
}

std::string Worker::how_it_ended() const
{
    if (status_ >= 0) return formatted("exit code {}", status_);
    const char* name = ::sigabbrev_np(-status_);
    return name != nullptr ? formatted("signal SIG{}", name) : formatted("signal {}", -status_);
}

std::string Worker::last_words() const
{
    std::string words(kLastWords, '\0');
    const off_t size = ::lseek(words_.get(), 0, SEEK_END);
    const ssize_t got = ::pread(words_.get(), words.data(), words.size(),
                                std::max<off_t>(0, size - static_cast<off_t>(words.size())));
    words.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    for (char& c : words)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    while (!words.empty() && words.back() == ' ') words.pop_back();
    return words.empty() ? "" : "; its last words: " + words;
}

void Worker::died(const Task& task)
{
    // The stream may close shortly before the process ends.
    for (int i = 0; i < kMostRounds && !has_ended(process_); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(cad_protocol::kTick));
    end("it crashed on " + task.subject);
    throw BackendError(Message("cad.worker_ended",
                               "{}: the CAD process ended while {}: {}{}. The file is damaged or Open "
                               "CASCADE cannot read it",
                               task.subject, doing(task), how_it_ended(), last_words())
                           .remedy("repair it in the CAD system or export it again"));
}

void Worker::give_up(const Task& task, const ProtocolError& error)
{
    end("it broke the protocol on " + task.subject);
    throw BackendError("cad.protocol", "{}: the CAD process sent invalid data while {}: {}", task.subject,
                       doing(task), error.what());
}

std::unique_lock<std::timed_mutex> Worker::enter(const Task& task)
{
    if (owner_ != ::getpid())
        throw WorkerGone(Message("cad.worker_ended",
                                 "{}: this process was forked, and the CAD process belongs to its parent",
                                 task.subject)
                             .remedy("load the CAD file in this process"));
    std::unique_lock lock(busy_, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(cad_protocol::kTick)))
        if (task.context != nullptr) check_cancelled(*task.context);
    notice_end();
    if (ended_)
        throw WorkerGone(Message("cad.worker_ended", "{}: the CAD process ended before this request ({})",
                                 task.subject, end_.empty() ? how_it_ended() : end_)
                             .remedy("try again, or allow more time (LACUNA_CAD_SECONDS) or memory "
                                     "(LACUNA_CAD_MEGABYTES)"));
    return lock;
}

Frame Worker::exchange(Opcode opcode, const std::string& bytes, const Task& task,
                       const std::vector<int>& descriptors)
{
    const double seconds = seconds_for(task);
    std::uint64_t charged = task.bytes * kMemoryPerByte + task.points * kMemoryPerPoint, memory = 0;
    Failure failure;
    try {
        flush_released();
        for (const auto& [handle, size] : charged_) charged += size * kMemoryPerByte;
        memory = memory_for(task, charged);
        limit_memory(memory);
        const Channel::Patience patience = patience_of(task.context, seconds, task.grace, pid_);
        channel_->send(opcode, bytes, descriptors, patience);
        for (;;) {
            Frame frame = channel_->receive(patience);
            if (frame.opcode == Opcode::done) return frame;
            if (frame.opcode == Opcode::failed) {
                failure = decode<Failure>(frame.bytes);
                break;
            }
            if (frame.opcode != Opcode::progress) throw ProtocolError("unexpected kind of reply");
            const double fraction = decode<Progress>(frame.bytes).fraction;
            if (task.context != nullptr && fraction >= 0 && fraction <= 1)
                report_progress(*task.context, task.stage, fraction);
        }
    } catch (const TimeOver&) {
        end("it exceeded its time limit on " + task.subject);
        throw BackendError(Message("cad.time_limit",
                                   "{}: {} took longer than {:.3g} s of processor time, and the CAD process "
                                   "was ended",
                                   task.subject, doing(task), needed(seconds))
                               .remedy("repair the file, or allow more with LACUNA_CAD_SECONDS"));
    } catch (const ChannelClosed&) {
        died(task);
    } catch (const ProtocolError& error) {
        give_up(task, error);
    } catch (...) { // Cancelled, or an exception of the progress callback: do not wait for the reply.
        end("it was stopped while working on " + task.subject);
        throw;
    }
    // If meshing throws, Gmsh keeps its lock and cannot mesh any more.
    const bool meshing = opcode == Opcode::recombine || opcode == Opcode::fill_skin;
    spent_ = spent_ || opcode == Opcode::load || (meshing && failure.kind == Failure::backend);
    switch (failure.kind) {
    case Failure::invalid_input:
        throw InvalidInput(Message(failure.message));
    case Failure::not_sweepable:
        throw NotSweepable(Message(failure.message));
    case Failure::out_of_memory:
        // The process may hold memory of the failed attempt, so it is killed.
        end("it ran out of memory on " + task.subject);
        throw BackendError(Message("cad.memory_limit",
                                   "{}: {} took more than the {} MB that the CAD process may use",
                                   task.subject, doing(task), needed(memory / kMegabyte))
                               .remedy("repair the file, or allow more with LACUNA_CAD_MEGABYTES"));
    default:
        throw BackendError(Message(failure.message));
    }
}

void Worker::limit_memory(std::uint64_t bytes) const
{
    rlimit limit{};
    if (::prlimit(pid_, RLIMIT_AS, nullptr, &limit) != 0) return;
    limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
    ::prlimit(pid_, RLIMIT_AS, &limit, nullptr);
}

void Worker::charge(std::uint64_t handle, std::uint64_t bytes)
{
    const std::lock_guard lock(busy_);
    charged_[handle] = bytes;
}

void Worker::flush_released()
{
    std::vector<std::uint64_t> handles;
    {
        const std::lock_guard lock(released_mutex_);
        handles.swap(released_);
    }
    for (const std::uint64_t handle : handles) {
        charged_.erase(handle);
        channel_->send(Opcode::release, encode(ReleaseRequest{handle}), {}, patience_of(nullptr, kSeconds));
    }
}

void Worker::release(std::uint64_t handle) noexcept
{
    if (::getpid() != owner_) return;
    try {
        {
            const std::lock_guard lock(released_mutex_);
            released_.push_back(handle);
        }
        const std::unique_lock lock(busy_, std::try_to_lock);
        if (lock && !ended_) flush_released();
    } catch (...) { // the process ended, or memory is exhausted; the next request notices it
    }
}

} // namespace lacuna::cad
