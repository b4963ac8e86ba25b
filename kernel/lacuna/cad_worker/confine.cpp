// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/confine.h>

#include <lacuna/core/error.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <ucontext.h>
#include <unistd.h>

namespace lacuna::cad_worker {

namespace {

// --- files by name ------------------------------------------------------------------------------------

constexpr char kFolder[] = "/lacuna-cad/"; // there is no such folder: it stands for the offered files

struct Offered {
    std::array<char, 512> path{};
    int descriptor = -1;
};
/// Read by a signal handler, so it neither grows nor moves: as many as one request may bring, and three more.
std::array<Offered, 256> offered_files;

const Offered* find_offered(const char* path)
{
    for (const Offered& file : offered_files)
        if (file.descriptor >= 0 && std::strcmp(file.path.data(), path) == 0) return &file;
    return nullptr;
}

// --- the trap -----------------------------------------------------------------------------------------

/// What a call carries in its unused sixth argument when it is this file's own. Whoever knows it can open
/// files to read, no more, and Landlock still holds.
std::uint64_t own_mark;

/// Flags an open that only reads does not have.
constexpr int kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);

long own_call(long number, long a, long b, long c, long d, long e = 0)
{
    const long result = ::syscall(number, a, b, c, d, e, static_cast<long>(own_mark));
    return result < 0 ? -errno : result;
}

long open_path(long folder, const char* path, long flags, long mode)
{
    if (std::strncmp(path, kFolder, sizeof(kFolder) - 1) != 0) {
        if ((flags & kWriting) != 0) return -EACCES;
        return own_call(SYS_openat, folder, reinterpret_cast<long>(path), flags, mode);
    }
    const Offered* file = find_offered(path);
    if (file == nullptr) return -ENOENT;
    if ((flags & kWriting) != 0) {
        if ((flags & O_TRUNC) != 0 && ::ftruncate(file->descriptor, 0) != 0) return -errno;
        ::lseek(file->descriptor, 0, SEEK_SET);
        const int copy = ::dup(file->descriptor);
        return copy < 0 ? -errno : copy;
    }
    // Opened anew, so that every reader has a place of its own in the file.
    std::array<char, 32> own{"/proc/self/fd/"};
    std::size_t end = std::strlen(own.data());
    std::array<char, 12> digits{};
    std::size_t count = 0;
    for (int n = file->descriptor; count == 0 || n > 0; n /= 10)
        digits[count++] = static_cast<char>('0' + n % 10);
    while (count > 0) own[end++] = digits[--count];
    return own_call(SYS_openat, AT_FDCWD, reinterpret_cast<long>(own.data()), O_RDONLY | O_CLOEXEC, 0);
}

/// Look at a path: an offered file's descriptor stands in for it.
template <class At, class Real>
long look_at(const char* path, At&& at, Real&& real)
{
    if (std::strncmp(path, kFolder, sizeof(kFolder) - 1) != 0) return real();
    const Offered* file = find_offered(path);
    return file == nullptr ? -ENOENT : at(file->descriptor);
}

long stat_path(long folder, const char* path, long into, long flags)
{
    return look_at(
        path,
        [&](int descriptor) {
            return own_call(SYS_newfstatat, descriptor, reinterpret_cast<long>(""), into, AT_EMPTY_PATH);
        },
        [&] { return own_call(SYS_newfstatat, folder, reinterpret_cast<long>(path), into, flags); });
}

long answer(long number, const std::array<long, 6>& a)
{
    const auto path = [](long argument) { return reinterpret_cast<const char*>(argument); };
    switch (number) {
    case SYS_openat:
        return open_path(a[0], path(a[1]), a[2], a[3]);
    case SYS_newfstatat:
        return stat_path(a[0], path(a[1]), a[2], a[3]);
    case SYS_faccessat:
    case SYS_faccessat2:
        return look_at(
            path(a[1]), [](int) { return 0L; }, [&] { return own_call(SYS_faccessat, a[0], a[1], a[2], 0); });
#ifdef SYS_open
    case SYS_open:
        return open_path(AT_FDCWD, path(a[0]), a[1], a[2]);
    case SYS_stat:
        return stat_path(AT_FDCWD, path(a[0]), a[1], 0);
    case SYS_lstat:
        return stat_path(AT_FDCWD, path(a[0]), a[1], AT_SYMLINK_NOFOLLOW);
    case SYS_access:
        return look_at(
            path(a[0]), [](int) { return 0L; },
            [&] { return own_call(SYS_faccessat, AT_FDCWD, a[0], a[1], 0); });
#endif
    default:
        return -ENOSYS;
    }
}

void on_trap(int, siginfo_t* info, void* context)
{
    const int before = errno;
    auto* machine = &static_cast<ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    auto& r = machine->gregs;
    const std::array<long, 6> arguments{r[REG_RDI], r[REG_RSI], r[REG_RDX], r[REG_R10], r[REG_R8], r[REG_R9]};
    r[REG_RAX] = answer(info->si_syscall, arguments);
#elif defined(__aarch64__)
    auto& r = machine->regs;
    std::array<long, 6> arguments{};
    for (std::size_t i = 0; i < 6; ++i) arguments[i] = static_cast<long>(r[i]);
    r[0] = static_cast<unsigned long long>(answer(info->si_syscall, arguments));
#endif
    errno = before;
}

// --- the filter ---------------------------------------------------------------------------------------

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#else
#error "the confinement of lacuna-cad knows x86-64 and 64-bit ARM; build with LACUNA_WITH_CAD=OFF elsewhere"
#endif

/// A seccomp program, built call by call. What no rule names fails with EPERM.
class Filter {
public:
    Filter()
    {
        load(offsetof(seccomp_data, arch));
        add(BPF_JMP | BPF_JEQ | BPF_K, kMachine, 1, 0);
        give(SECCOMP_RET_KILL_PROCESS);
        load(offsetof(seccomp_data, nr));
    }
    void always(long number, std::uint32_t verdict) // the number is loaded before and after
    {
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1);
        give(verdict);
    }
    void allow(std::initializer_list<long> numbers)
    {
        for (const long number : numbers) always(number, SECCOMP_RET_ALLOW);
    }
    /// One verdict where (argument & mask) == value in its lower half, another elsewhere.
    void when(long number, int argument, std::uint32_t mask, std::uint32_t value, std::uint32_t then,
              std::uint32_t otherwise)
    {
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 5);
        load(lower(argument));
        add(BPF_ALU | BPF_AND | BPF_K, mask, 0, 0);
        add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
        give(then);
        give(otherwise);
    }
    /// Trap a call that does not carry the mark; with it, allow it where (argument & mask) == 0.
    void trap(long number, std::uint64_t mark, int argument = 0, std::uint32_t mask = 0)
    {
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 10);
        load(lower(5));
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(mark), 0, 7);
        load(lower(5) + 4);
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(mark >> 32), 0, 5);
        load(lower(argument));
        add(BPF_ALU | BPF_AND | BPF_K, mask, 0, 0);
        add(BPF_JMP | BPF_JEQ | BPF_K, 0, 0, 1);
        give(SECCOMP_RET_ALLOW);
        give(SECCOMP_RET_ERRNO | EACCES);
        give(SECCOMP_RET_TRAP);
    }
    bool install()
    {
        give(SECCOMP_RET_ERRNO | EPERM);
        sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
        return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
    }

private:
    static std::uint32_t lower(int argument) // half of an argument, on a little-endian machine
    {
        return static_cast<std::uint32_t>(offsetof(seccomp_data, args)) +
               8 * static_cast<std::uint32_t>(argument);
    }
    void add(int code, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false)
    {
        code_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
    }
    void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset), 0, 0); }
    void give(std::uint32_t verdict) { add(BPF_RET | BPF_K, verdict, 0, 0); }

    std::vector<sock_filter> code_;
};

bool install_filter()
{
    constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW, kRefuse = SECCOMP_RET_ERRNO | EPERM;
    Filter filter;
    // Files by name. Creating, removing, renaming, linking and the like are named nowhere, so they fail.
    filter.trap(SYS_openat, own_mark, 2, kWriting);
    filter.trap(SYS_newfstatat, own_mark);
    filter.trap(SYS_faccessat, own_mark);
    filter.always(SYS_faccessat2, SECCOMP_RET_TRAP);
#ifdef SYS_open
    for (const long number : {SYS_open, SYS_stat, SYS_lstat, SYS_access})
        filter.always(number, SECCOMP_RET_TRAP);
    filter.allow({SYS_poll, SYS_select, SYS_time, SYS_arch_prctl});
#endif
    // Threads, but no processes. clone3 hides its flags in memory; without it, clone is used.
    filter.when(SYS_clone, 0, CLONE_THREAD, CLONE_THREAD, kAllow, kRefuse);
    filter.always(SYS_clone3, SECCOMP_RET_ERRNO | ENOSYS);
    // Signals to itself alone; the trap's own handler stays.
    filter.when(SYS_tgkill, 0, ~0U, static_cast<std::uint32_t>(::getpid()), kAllow, kRefuse);
    filter.when(SYS_rt_sigaction, 0, ~0U, SIGSYS, SECCOMP_RET_ERRNO | 0, kAllow);
    // Limits can be read; a terminal asked for.
    filter.when(SYS_prlimit64, 2, ~0U, 0, kAllow, kRefuse);
    filter.when(SYS_ioctl, 1, ~0U, 0x5401 /* TCGETS */, kAllow, kRefuse);
    filter.when(SYS_prctl, 0, ~0U, PR_SET_NAME, kAllow, kRefuse);
    filter.allow({SYS_read,
                  SYS_write,
                  SYS_readv,
                  SYS_writev,
                  SYS_pread64,
                  SYS_pwrite64,
                  SYS_lseek,
                  SYS_close,
                  SYS_fstat,
                  SYS_ftruncate,
                  SYS_dup,
                  SYS_fcntl,
                  SYS_mmap,
                  SYS_munmap,
                  SYS_mprotect,
                  SYS_mremap,
                  SYS_madvise,
                  SYS_brk,
                  SYS_rt_sigprocmask,
                  SYS_rt_sigreturn,
                  SYS_sigaltstack,
                  SYS_futex,
                  SYS_sched_yield,
                  SYS_sched_getaffinity,
                  SYS_getpid,
                  SYS_gettid,
                  SYS_getppid,
                  SYS_getuid,
                  SYS_geteuid,
                  SYS_getgid,
                  SYS_getegid,
                  SYS_getrusage,
                  SYS_times,
                  SYS_clock_gettime,
                  SYS_clock_getres,
                  SYS_gettimeofday,
                  SYS_nanosleep,
                  SYS_clock_nanosleep,
                  SYS_ppoll,
                  SYS_pselect6,
                  SYS_sendmsg,
                  SYS_recvmsg,
                  SYS_exit,
                  SYS_exit_group,
                  SYS_set_robust_list,
                  SYS_getrandom,
                  SYS_uname,
                  SYS_sysinfo,
                  SYS_set_tid_address,
                  SYS_membarrier,
                  SYS_getcwd,
                  SYS_readlinkat,
                  SYS_getdents64,
                  SYS_rt_sigtimedwait,
                  SYS_restart_syscall,
                  SYS_getcpu});
#ifdef SYS_rseq
    filter.allow({SYS_rseq});
#endif
    return filter.install();
}

// --- Landlock -----------------------------------------------------------------------------------------

/// As the newest kernels know it; older ones are given its beginning.
struct Ruleset {
    std::uint64_t files = 0, net = 0, scoped = 0;
};

bool restrict_files()
{
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return false;
    Ruleset rules;
    const int bits = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
    rules.files = (std::uint64_t{1} << bits) - 1;
    if (version >= 4) rules.net = 3;    // bind and connect
    if (version >= 6) rules.scoped = 3; // abstract sockets and signals of others
    const std::size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
    const int set = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, size, 0));
    if (set < 0) return false;
    // What the libraries still load when they are first used.
    for (const char* folder : {"/usr", "/lib", "/lib64"}) {
        const int beneath = ::open(folder, O_PATH | O_CLOEXEC);
        if (beneath < 0) continue;
        landlock_path_beneath_attr rule{};
        rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
        rule.parent_fd = beneath;
        ::syscall(SYS_landlock_add_rule, set, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
        ::close(beneath);
    }
    const bool done = ::syscall(SYS_landlock_restrict_self, set, 0) == 0;
    ::close(set);
    return done;
}

} // namespace

void keep_from_writing()
{
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    Ruleset rules;
    rules.files = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR |
                  LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR;
    const int set = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof(rules.files), 0));
    if (set < 0) return;
    ::syscall(SYS_landlock_restrict_self, set, 0);
    ::close(set);
}

std::string confine()
{
    struct sigaction action {};
    action.sa_sigaction = on_trap;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    if (::getrandom(&own_mark, sizeof(own_mark), 0) != sizeof(own_mark) ||
        ::sigaction(SIGSYS, &action, nullptr) != 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        throw BackendError("cad.no_wall", "the CAD process cannot be confined");
    const bool landlock = restrict_files();
    if (!install_filter())
        throw BackendError("cad.no_wall",
                           "the CAD process cannot be confined: the kernel has no seccomp filters");
    return landlock ? "" : "Landlock, which keeps the CAD process from reading other files";
}

std::string offer(const std::string& folder, const std::string& name, int descriptor)
{
    const std::string path = kFolder + folder + "/" + name;
    for (Offered& file : offered_files) {
        if (file.descriptor >= 0) continue;
        if (descriptor < 0 || path.size() >= file.path.size()) break;
        std::memcpy(file.path.data(), path.c_str(), path.size() + 1);
        file.descriptor = descriptor;
        return path;
    }
    throw BackendError("cad.too_many_files", "too many files at once, or a name that is too long: " + name);
}

void withdraw(const std::string& folder)
{
    const std::string beginning = kFolder + folder + "/";
    for (Offered& file : offered_files)
        if (file.descriptor >= 0 && std::strncmp(file.path.data(), beginning.c_str(), beginning.size()) == 0)
            file.descriptor = -1;
}

} // namespace lacuna::cad_worker
