// SPDX-License-Identifier: MIT
#include <lacuna/io/whole_file.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/whole_folder.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <system_error>
#include <tuple>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#ifndef RWF_DONTCACHE
#define RWF_DONTCACHE 0x80 // Linux 6.14; for headers that lack it
#endif

namespace lacuna::io {
namespace fs = std::filesystem;
namespace {

/// The path or, if the path is a link, its target. Writing then replaces the target and keeps the link.
fs::path resolved(const std::string& path)
{
    std::error_code ignored;
    if (fs::is_symlink(path, ignored)) {
        fs::path target = fs::weakly_canonical(path, ignored);
        if (!ignored) return target;
    }
    return path;
}

[[noreturn]] void refuse_folder(const std::string& path, int error)
{
    throw InvalidInput(Message("io.no_folder", "the folder '{}' cannot be used: {}", path,
                               std::generic_category().message(error))
                           .remedy("create it first, or give another path"));
}

/// Beginning of the name of a temporary file next to the path; the number of the process follows. State
/// "unfinished": the file is still being written. State "replacing": it is complete and about to replace a
/// file.
std::string prefix_beside(const std::string& name, const char* state)
{
    // The temporary name must not exceed the file system's limit, however long `name` is.
    constexpr std::size_t kLongest = 200;
    return "." + name.substr(0, kLongest) + "." + state + "-";
}

std::string numbered(const std::string& prefix, std::uint64_t number)
{
    return formatted("{}{}-{}", prefix, ::getpid(), number);
}

/// A number that nobody has used before in a name, with high probability.
std::uint64_t new_number()
{
    std::uint64_t number = 0;
    if (::getentropy(&number, sizeof number) == 0) return number;
    timespec now = {};
    ::clock_gettime(CLOCK_REALTIME, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

/// Whether the process that wrote a file has ended. A running process holds a lock on its file. On file
/// systems without locks, no file counts as abandoned.
bool is_abandoned(int folder, const char* name)
{
    const int descriptor = ::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    ::close(descriptor);
    return locked;
}

/// Age after which a file without writes counts as abandoned [s]. The number of its process does not help,
/// because that process may run on another machine. A lower value could remove files of slow writers; a
/// higher one keeps abandoned files longer.
constexpr std::time_t kLeftOver = 3600;

/// Files bypass the page cache if they are larger than the system's memory divided by this. Linux makes
/// writers wait when about a fifth of the memory holds data not yet on disk, so for larger files the cache
/// saves no time. Not measured.
constexpr std::uint64_t kCachedShare = 8;

std::uint64_t share_of_memory()
{
    const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
    if (pages <= 0 || size <= 0) return std::numeric_limits<std::uint64_t>::max();
    return static_cast<std::uint64_t>(pages) / kCachedShare * static_cast<std::uint64_t>(size);
}

} // namespace

Folder::Folder(const std::string& path)
{
    std::error_code ignored;
    path_ = fs::weakly_canonical(path, ignored).string();
    descriptor_ = ::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) refuse_folder(path, errno);
}

Folder::~Folder() { ::close(descriptor_); }

std::shared_ptr<const Folder> Folder::inside(const std::string& name) const
{
    const int descriptor = ::openat(descriptor_, name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    const std::string path = (fs::path(path_) / name).string();
    if (descriptor < 0) refuse_folder(path, errno);
    return std::shared_ptr<const Folder>(new Folder(descriptor, path));
}

OutputPath OutputPath::below(const std::shared_ptr<const Folder>& folder, const std::string& path)
{
    const auto outside = [&](const std::string& why) -> InvalidInput {
        return {"io.outside", "'{}' is not below {}: {}", path, folder->path(), why};
    };
    fs::path inside = fs::path(path);
    if (inside.is_absolute()) {
        inside = inside.lexically_relative(folder->path());
        if (inside.empty() || *inside.begin() == "..") throw outside("it leads to another place");
    }
    OutputPath result(path);
    result.folder_ = folder;
    for (auto part = inside.begin(); part != inside.end(); ++part) {
        if (*part == "..") throw outside("'..' may lead out of it");
        if (std::next(part) == inside.end()) {
            result.name_ = part->string();
        } else if (!part->empty() && *part != ".") {
            struct stat status = {};
            if (::fstatat(result.folder_->descriptor(), part->c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                S_ISLNK(status.st_mode))
                throw outside(formatted("'{}' is a link", part->string()));
            result.folder_ = result.folder_->inside(part->string());
        }
    }
    return result;
}

OutputPath OutputPath::beside(const std::string& name) const
{
    OutputPath other((fs::path(path_).parent_path() / name).string());
    other.folder_ = folder_;
    if (folder_) other.name_ = name;
    return other;
}

std::pair<std::shared_ptr<const Folder>, std::string> OutputPath::place() const
{
    if (folder_) return {folder_, name_};
    const fs::path target = resolved(path_);
    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code ignored;
    if (!fs::is_directory(parent, ignored))
        throw InvalidInput(
            Message("io.no_folder", "cannot write '{}': there is no folder '{}'", path_, parent.string())
                .remedy("create it first, or give another path"));
    return {std::make_shared<const Folder>(parent.string()), target.filename().string()};
}

WholeFile::WholeFile(const OutputPath& path, Naming naming) : path_(path.text()), cached_(share_of_memory())
{
    if (path_.empty()) throw InvalidInput("io.no_path", "no file name was given");
    std::tie(folder_, name_) = path.place();
    struct stat before = {};
    const bool exists = ::fstatat(folder_->descriptor(), name_.empty() ? "." : name_.c_str(), &before,
                                  AT_SYMLINK_NOFOLLOW) == 0;
    if (!exists && errno != ENOENT) fail(errno); // the name is too long, or the folder cannot be searched
    if (name_.empty() || (exists && S_ISDIR(before.st_mode)))
        throw InvalidInput(
            Message("io.not_a_file", "cannot write '{}': it is a folder", path_).remedy("add a file name"));
    if (exists && !S_ISREG(before.st_mode))
        throw InvalidInput(Message("io.not_a_file", "cannot write '{}': it is not a plain file", path_)
                               .remedy("give another path"));
    if (naming == Naming::none) open_unnamed();
    if (descriptor_ < 0) open_named();
    if (exists && ::fchmod(descriptor_, before.st_mode & 07777) != 0) fail(errno);
}

void WholeFile::open_unnamed()
{
#ifdef O_TMPFILE
    // Without privileges, a nameless file can get a name only through /proc.
    if (::access("/proc/self/fd", X_OK) != 0) return;
    descriptor_ = ::openat(folder_->descriptor(), ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
#endif
}

void WholeFile::remove_left_over(const std::string& prefix,
                                 const std::function<bool(const LeftOver&)>& is_left_over) const
{
    const int folder = folder_->descriptor();
    for (const std::string& name : names_in(folder, ".")) {
        if (!name.starts_with(prefix)) continue;
        LeftOver file{folder, name.c_str()};
        const auto read = std::from_chars(name.data() + prefix.size(), name.data() + name.size(),
                                          file.process);
        if (read.ec != std::errc() || *read.ptr != '-' || file.process <= 0) continue;
        struct stat status = {};
        if (::fstatat(folder, file.name, &status, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(status.st_mode))
            continue;
        file.written = status.st_mtime;
        if (is_left_over(file)) ::unlinkat(folder, file.name, 0);
    }
}

void WholeFile::open_named()
{
    const std::string prefix = prefix_beside(name_, "unfinished");
    remove_left_over(prefix, [](const LeftOver& file) {
        const bool runs = ::kill(file.process, 0) == 0 || errno != ESRCH;
        return !runs && std::time(nullptr) - file.written >= kLeftOver;
    });
    // Create the file exclusively, so that two writers never use the same name.
    for (std::uint64_t attempt = 0; descriptor_ < 0; ++attempt) {
        unfinished_ = numbered(prefix, attempt);
        descriptor_ = ::openat(folder_->descriptor(), unfinished_.c_str(),
                               O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) {
            const int error = errno;
            unfinished_.clear();
            fail(error);
        }
    }
}

WholeFile::~WholeFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!unfinished_.empty()) ::unlinkat(folder_->descriptor(), unfinished_.c_str(), 0);
}

std::string WholeFile::unfinished_path() const
{
    if (unfinished_.empty()) return formatted("/proc/{}/fd/{}", ::getpid(), descriptor_);
    return (fs::path(folder_->path()) / unfinished_).string();
}

void WholeFile::fail(int error)
{
    Message failed("io.write_failed", "cannot write '{}': {}. No partial file was left", path_,
                   std::generic_category().message(error));
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        failed = failed.remedy("free some space, or write to another disk");
    if (error == EMFILE) failed = failed.remedy("ask for fewer partitions");
    throw BackendError(std::move(failed));
}

void WholeFile::reserve(std::uint64_t begin, std::uint64_t end)
{
    reserved_ = std::max(reserved_, end);
#ifdef FALLOC_FL_KEEP_SIZE
    if (begin >= end) return;
    while (::fallocate(descriptor_, 0, static_cast<off_t>(begin), static_cast<off_t>(end - begin)) != 0) {
        if (errno == EINTR) continue;
        if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG) fail(errno);
        return; // the file system does not support it
    }
#endif
}

/// Write some of the bytes. If a file bypasses the page cache, its pages are released as soon as the disk has
/// them, so that they are reused. On a virtual machine whose memory is allocated on demand, a new page costs
/// ten times as much as copying one: writing 6 GB took 22 s of processor time, with reuse 1.5 s.
ssize_t WholeFile::write_some(std::uint64_t offset, std::string_view bytes)
{
#ifdef __linux__
    if (can_pass_cache_ && std::max(reserved_, offset + bytes.size()) > cached_) {
        const iovec piece{const_cast<char*>(bytes.data()), bytes.size()};
        const ssize_t done = ::pwritev2(descriptor_, &piece, 1, static_cast<off_t>(offset), RWF_DONTCACHE);
        if (done >= 0 || (errno != EOPNOTSUPP && errno != ENOSYS && errno != EINVAL)) return done;
        can_pass_cache_ = false; // the system or the file system does not support it
    }
#endif
    return ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
}

void WholeFile::write_at(std::uint64_t offset, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t done = write_some(offset, bytes);
        if (done < 0) {
            if (errno == EINTR) continue;
            fail(errno);
        }
        offset += static_cast<std::uint64_t>(done);
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
}

void WholeFile::append(std::string_view bytes)
{
    write_at(end_, bytes);
    end_ += bytes.size();
}

void WholeFile::publish_unnamed()
{
    // Closing a file may report errors that writing did not. So close a duplicate before the file is moved to
    // its path.
    const int other = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
    if (other >= 0 && ::close(other) != 0) fail(errno);
    const std::string source = formatted("/proc/self/fd/{}", descriptor_);
    const auto link_as = [&](const std::string& name) {
        return ::linkat(AT_FDCWD, source.c_str(), folder_->descriptor(), name.c_str(), AT_SYMLINK_FOLLOW) ==
               0;
    };
    if (link_as(name_)) return;
    if (errno != EEXIST) fail(errno);
    // Linking does not replace an existing file, but renaming does. So the file has a temporary name during
    // two system calls. Its lock shows that it is not abandoned. The number of its process would not show
    // this, because containers reuse process numbers.
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
    const std::string prefix = prefix_beside(name_, "replacing");
    remove_left_over(prefix, [](const LeftOver& file) { return is_abandoned(file.folder, file.name); });
    // Use a name that nobody has used before. A process that removes an abandoned file then cannot remove
    // this one.
    const std::string between = numbered(prefix, new_number());
    if (!link_as(between)) fail(errno);
    if (::renameat(folder_->descriptor(), between.c_str(), folder_->descriptor(), name_.c_str()) == 0) return;
    const int error = errno;
    ::unlinkat(folder_->descriptor(), between.c_str(), 0);
    fail(error);
}

void WholeFile::commit()
{
    if (unfinished_.empty()) {
        publish_unnamed();
        ::close(descriptor_);
        descriptor_ = -1;
        return;
    }
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail(errno);
    if (::renameat(folder_->descriptor(), unfinished_.c_str(), folder_->descriptor(), name_.c_str()) != 0)
        fail(errno);
    unfinished_.clear();
}

void WholeFile::remove_placed() const noexcept { ::unlinkat(folder_->descriptor(), name_.c_str(), 0); }

void commit_together(std::span<const std::unique_ptr<WholeFile>> files)
{
    if (files.empty()) return;
    files.back()->remove_placed();
    std::size_t placed = 0;
    try {
        for (; placed < files.size(); ++placed) files[placed]->commit();
    } catch (...) {
        for (std::size_t f = 0; f < placed; ++f) files[f]->remove_placed();
        throw;
    }
}

} // namespace lacuna::io
