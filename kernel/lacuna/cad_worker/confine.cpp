// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/confine.h>

#include <lacuna/core/error.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <sstream>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
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

constexpr char kFolder[] = "/lacuna-cad/"; // not a real folder: a prefix for the names of offered files

struct Offered {
    std::array<char, 512> path{};
    int descriptor = -1;
};
/// A fixed array, because a signal handler reads it. One request sends at most 250 files.
std::array<Offered, 256> offered_files;

const Offered* find_offered(const char* path)
{
    for (const Offered& file : offered_files)
        if (file.descriptor >= 0 && std::strcmp(file.path.data(), path) == 0) return &file;
    return nullptr;
}

// --- the trap -----------------------------------------------------------------------------------------

/// A secret value that system calls of this file pass as their unused sixth argument. Code that learns it
/// could only open files for reading, within the limits of Landlock.
std::uint64_t own_mark;

/// Flags of open() that are all absent if a file is opened for reading only.
constexpr int kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);

long own_call(long number, long a, long b, long c, long d, long e = 0)
{
    const long result = ::syscall(number, a, b, c, d, e, static_cast<long>(own_mark));
    return result < 0 ? -errno : result;
}

long open_offered(const Offered& file, long flags)
{
    if ((flags & kWriting) != 0) {
        if ((flags & O_TRUNC) != 0 && ::ftruncate(file.descriptor, 0) != 0) return -errno;
        ::lseek(file.descriptor, 0, SEEK_SET);
        const int copy = ::dup(file.descriptor);
        return copy < 0 ? -errno : copy;
    }
    // Open it again, so that each reader has its own file offset.
    std::array<char, 32> own{"/proc/self/fd/"};
    std::to_chars(own.data() + std::strlen(own.data()), own.data() + own.size() - 1, file.descriptor);
    return own_call(SYS_openat, AT_FDCWD, reinterpret_cast<long>(own.data()), O_RDONLY | O_CLOEXEC, 0);
}

/// Answer a trapped call that opens or inspects a path. For an offered file, the answer comes from its
/// descriptor. Other paths are passed to the kernel, but never opened for writing.
long answer_at(long number, const std::array<long, 6>& a)
{
    const auto* path = reinterpret_cast<const char*>(a[1]);
    const bool ours = std::strncmp(path, kFolder, sizeof(kFolder) - 1) == 0;
    const Offered* file = ours ? find_offered(path) : nullptr;
    if (ours && file == nullptr) return -ENOENT;
    switch (number) {
    case SYS_openat:
        if (file != nullptr) return open_offered(*file, a[2]);
        return (a[2] & kWriting) != 0 ? -EACCES : own_call(SYS_openat, a[0], a[1], a[2], a[3]);
    case SYS_newfstatat:
        if (file == nullptr) return own_call(SYS_newfstatat, a[0], a[1], a[2], a[3]);
        return own_call(SYS_newfstatat, file->descriptor, reinterpret_cast<long>(""), a[2], AT_EMPTY_PATH);
    default:
        return file != nullptr ? 0 : own_call(SYS_faccessat, a[0], a[1], a[2], 0);
    }
}

long answer(long number, const std::array<long, 6>& a)
{
    switch (number) {
    case SYS_openat:
    case SYS_newfstatat:
    case SYS_faccessat:
        return answer_at(number, a);
    case SYS_faccessat2:
        return answer_at(SYS_faccessat, a);
#ifdef SYS_open
    case SYS_open:
        return answer_at(SYS_openat, {AT_FDCWD, a[0], a[1], a[2]});
    case SYS_stat:
        return answer_at(SYS_newfstatat, {AT_FDCWD, a[0], a[1], 0});
    case SYS_lstat:
        return answer_at(SYS_newfstatat, {AT_FDCWD, a[0], a[1], AT_SYMLINK_NOFOLLOW});
    case SYS_access:
        return answer_at(SYS_faccessat, {AT_FDCWD, a[0], a[1]});
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
#else
#error "the confinement of lacuna-cad knows x86-64 and 64-bit ARM; build with LACUNA_WITH_CAD=OFF elsewhere"
#endif
    errno = before;
}

// --- the filter ---------------------------------------------------------------------------------------

/// A seccomp filter. A call without a rule fails with EPERM; a call of another architecture kills the
/// process.
class Filter {
public:
    Filter() : rules_{seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release}
    {
        if (rules_ == nullptr ||
            seccomp_attr_set(rules_.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS) != 0 ||
            seccomp_attr_set(rules_.get(), SCMP_FLTATR_CTL_TSYNC, 1) != 0)
            fail();
    }
    /// Set the action for a call, used if all conditions hold.
    void on(int number, std::uint32_t action, std::initializer_list<scmp_arg_cmp> conditions = {})
    {
        if (seccomp_rule_add_array(rules_.get(), action, number, static_cast<unsigned>(conditions.size()),
                                   std::data(conditions)) != 0)
            fail();
    }
    /// Allow a call if the lower half of an argument, masked, has a given value.
    void allow_where(int number, unsigned argument, std::uint32_t mask, std::uint32_t value)
    {
        on(number, SCMP_ACT_ALLOW, {masked(argument, mask, value)});
    }
    /// Trap a call that does not carry the mark.
    void trap_unmarked(int number) { on(number, SCMP_ACT_TRAP, {{5, SCMP_CMP_NE, own_mark, 0}}); }
    /// Allow a call that carries the mark, if the lower half of an argument has no bit of the mask.
    void allow_marked(int number, unsigned argument = 0, std::uint32_t mask = 0)
    {
        on(number, SCMP_ACT_ALLOW, {{5, SCMP_CMP_EQ, own_mark, 0}, masked(argument, mask, 0)});
    }
    bool install() { return seccomp_load(rules_.get()) == 0; }
    bool write_text(int descriptor) { return seccomp_export_pfc(rules_.get(), descriptor) == 0; }

private:
    static scmp_arg_cmp masked(unsigned argument, std::uint32_t mask, std::uint32_t value)
    {
        return {argument, SCMP_CMP_MASKED_EQ, mask, value};
    }
    [[noreturn]] static void fail()
    {
        throw BackendError(
            Message("cad.no_wall", "the CAD process cannot be confined: libseccomp failed to make a filter")
                .remedy("check the installation of libseccomp"));
    }

    std::unique_ptr<void, void (*)(void*)> rules_;
};

Filter make_filter()
{
    Filter filter;
    // Calls that create, remove, rename or link by path have no rule, so they fail.
    for (const int number : {SCMP_SYS(openat), SCMP_SYS(newfstatat), SCMP_SYS(faccessat)})
        filter.trap_unmarked(number);
    filter.allow_marked(SCMP_SYS(openat), 2, kWriting);
    filter.allow_marked(SCMP_SYS(newfstatat));
    filter.allow_marked(SCMP_SYS(faccessat));
    for (const int number :
         {SCMP_SYS(faccessat2), SCMP_SYS(open), SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(access)})
        filter.on(number, SCMP_ACT_TRAP);
    // Threads are allowed, processes are not. clone3 has its flags in memory; without it, libc uses clone.
    filter.allow_where(SCMP_SYS(clone), 0, CLONE_THREAD, CLONE_THREAD);
    filter.on(SCMP_SYS(clone3), SCMP_ACT_ERRNO(ENOSYS));
    // Allow signals only to this process, and do not let it replace the SIGSYS handler.
    filter.allow_where(SCMP_SYS(tgkill), 0, ~0U, static_cast<std::uint32_t>(::getpid()));
    for (scmp_datum_t signal = 1; signal <= static_cast<scmp_datum_t>(SIGRTMAX); ++signal)
        filter.on(SCMP_SYS(rt_sigaction), signal == SIGSYS ? SCMP_ACT_ERRNO(0) : SCMP_ACT_ALLOW,
                  {{0, SCMP_CMP_EQ, signal, 0}});
    // Allow reading limits and checking for a terminal.
    filter.allow_where(SCMP_SYS(prlimit64), 2, ~0U, 0);
    filter.allow_where(SCMP_SYS(ioctl), 1, ~0U, 0x5401 /* TCGETS */);
    filter.allow_where(SCMP_SYS(prctl), 0, ~0U, PR_SET_NAME);
    std::istringstream allowed(
        "poll select time arch_prctl read write readv writev pread64 pwrite64 lseek close fstat "
        "ftruncate dup fcntl mmap munmap mprotect mremap madvise brk rt_sigprocmask rt_sigreturn "
        "sigaltstack futex sched_yield sched_getaffinity getpid gettid getppid getuid geteuid getgid "
        "getegid getrusage times clock_gettime clock_getres gettimeofday nanosleep clock_nanosleep "
        "ppoll pselect6 sendmsg recvmsg exit exit_group set_robust_list getrandom uname sysinfo "
        "set_tid_address membarrier getcwd readlinkat getdents64 rt_sigtimedwait restart_syscall "
        "getcpu rseq");
    for (std::string name; allowed >> name;)
        filter.on(seccomp_syscall_resolve_name(name.c_str()), SCMP_ACT_ALLOW);
    return filter;
}

// --- Landlock -----------------------------------------------------------------------------------------

/// Landlock's structure in the newest kernels; older kernels get only its first part.
struct Ruleset {
    std::uint64_t files = 0, net = 0, scoped = 0;
};

/// The version of Landlock that the kernel supports; below 1: none.
long landlock_version()
{
    return ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
}

/// Restrict this process. @param size  size of the part of the rules that the kernel knows
/// @param readable  folders in which files may be read. @return false if it failed
bool restrict_by(const Ruleset& rules, std::size_t size, std::initializer_list<const char*> readable)
{
    const int set = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, size, 0));
    if (set < 0) return false;
    for (const char* folder : readable) {
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

bool restrict_files()
{
    const long version = landlock_version();
    if (version < 1) return false;
    Ruleset rules;
    const int bits = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
    rules.files = (std::uint64_t{1} << bits) - 1;
    if (version >= 4) rules.net = 3;    // bind and connect
    if (version >= 6) rules.scoped = 3; // abstract sockets and signals of other processes
    const std::size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
    return restrict_by(rules, size, {"/usr", "/lib", "/lib64"}); // libraries that are loaded on first use
}

} // namespace

void keep_from_writing()
{
    if (landlock_version() < 1 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    Ruleset rules;
    rules.files = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR |
                  LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR;
    restrict_by(rules, sizeof(rules.files), {});
}

std::string confine()
{
    struct sigaction action {};
    action.sa_sigaction = on_trap;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    if (::getrandom(&own_mark, sizeof(own_mark), 0) != sizeof(own_mark) ||
        ::sigaction(SIGSYS, &action, nullptr) != 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        throw BackendError("cad.no_wall", "the CAD process cannot be confined: {}", std::strerror(errno));
    const bool landlock = restrict_files();
    if (!make_filter().install())
        throw BackendError(
            Message("cad.no_wall",
                    "the CAD process cannot be confined: the Linux kernel of this system has no "
                    "seccomp filters")
                .remedy("use a kernel with CONFIG_SECCOMP_FILTER"));
    return landlock ? "" : "Landlock, which keeps the CAD process from reading other files";
}

bool write_filter(int descriptor) { return make_filter().write_text(descriptor); }

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
    throw BackendError(Message("cad.too_many_files",
                               "there are too many files in one request, or a file name is too long: {}",
                               name)
                           .remedy("load fewer files at once, or shorten the name"));
}

void withdraw(const std::string& folder)
{
    const std::string beginning = kFolder + folder + "/";
    for (Offered& file : offered_files)
        if (file.descriptor >= 0 && std::strncmp(file.path.data(), beginning.c_str(), beginning.size()) == 0)
            file.descriptor = -1;
}

} // namespace lacuna::cad_worker
