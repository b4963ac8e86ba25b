// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace lacuna::io {

/// A folder that is held open: it stays the same one even if its path comes to mean another.
class Folder {
public:
    /// @throw InvalidInput "io.no_folder"  there is no such folder, or it may not be entered.
    explicit Folder(const std::string& path);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] const std::string& path() const { return path_; }

    /// A folder inside this one.
    /// @param name  one component of a path; a link is refused.
    /// @throw InvalidInput "io.no_folder"
    [[nodiscard]] std::shared_ptr<const Folder> inside(const std::string& name) const;

private:
    Folder(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)) {}

    int descriptor_ = -1;
    std::string path_; ///< for messages, absolute
};

/// Where a file shall be written. A plain path is resolved as the shell does, links included.
class OutputPath {
public:
    OutputPath(std::string path) : path_(std::move(path)) {}        // NOLINT(google-explicit-constructor)
    OutputPath(const char* path) : OutputPath(std::string(path)) {} // NOLINT(google-explicit-constructor)

    /// A path below a folder that is held open: no part of it may be a link or lead out.
    /// @throw InvalidInput "io.outside"  the path leads out of the folder, through `..` or a link.
    static OutputPath below(const std::shared_ptr<const Folder>& folder, const std::string& path);

    /// Another file of the same folder. @param name  one component of a path
    [[nodiscard]] OutputPath beside(const std::string& name) const;
    /// As the person knows it; its ending says the format.
    [[nodiscard]] const std::string& text() const { return path_; }

private:
    friend class WholeFile;
    friend class WholeFolder;
    /// The folder that it lies in and its name there. @throw InvalidInput "io.no_folder"
    [[nodiscard]] std::pair<std::shared_ptr<const Folder>, std::string> place() const;

    std::string path_;
    std::shared_ptr<const Folder> folder_; ///< null: the path is resolved when the file is opened
    std::string name_;                     ///< inside the folder
};

/// A file that is there whole or not at all.
///
/// Its bytes go to a file without a name (`O_TMPFILE`), which `commit()` puts in its place. So nothing is
/// left behind whatever ends the writing, a kill included. On a file system without nameless files it has a
/// name of its own beside the place, which the destructor removes. A file that was there before stays until
/// then, and its mode is kept. To replace one takes two system calls with a name beside the place in between:
/// a kill between them leaves the whole new file there under a hidden name, which the next replacing removes.
class WholeFile {
public:
    /// Whether processes of other machines open it too, which takes a name. One that is killed then leaves it
    /// behind; the next such writing of the same file removes it, an hour after it was last written to.
    enum class Naming { none, named };

    /// @throw InvalidInput  the folder does not exist, or the path is not that of a file.
    /// @throw BackendError  the folder cannot be written to.
    explicit WholeFile(const OutputPath& path, Naming naming = Naming::none);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Take room for the bytes [begin, end), where the file system can: what is written there finds its
    /// blocks in place, and a disk that is too small is told before anything is made. The file reaches to
    /// `end` from then on. Measured for 116 MB: 24 ms of writing instead of 33.
    /// @throw BackendError  the disk is full.
    void reserve(std::uint64_t begin, std::uint64_t end);
    /// A file that reaches beyond this is handed to the disk as it is written and does not stay in the
    /// system's memory, where the system can do so (Linux 6.14). By default an eighth of that memory [bytes].
    void cache_up_to(std::uint64_t bytes) { cached_ = bytes; }
    /// Write bytes at a place of their own; several threads may do so at once.
    /// @throw BackendError  the disk is full.
    void write_at(std::uint64_t offset, std::string_view bytes);
    /// Write bytes behind those appended so far.
    void append(std::string_view bytes);
    /// Where other processes find it meanwhile: beside its place where it has a name, else among the open
    /// files of this process, which those of its machine and user can open.
    [[nodiscard]] std::string unfinished_path() const;
    /// Put the file in its place. @throw BackendError
    void commit();

private:
    friend void commit_together(std::span<const std::unique_ptr<WholeFile>> files);
    [[noreturn]] void fail(int error);
    ssize_t write_some(std::uint64_t offset, std::string_view bytes);
    void open_unnamed();
    void open_named();
    struct LeftOver {
        int folder;              ///< it is in
        const char* name;        ///< inside the folder
        pid_t process = 0;       ///< that made it, by its name
        std::time_t written = 0; ///< last [s]
    };
    /// Remove files beside the place whose names begin so and that are left over.
    void remove_left_over(const std::string& prefix,
                          const std::function<bool(const LeftOver&)>& is_left_over) const;
    void publish_unnamed();
    void remove_placed() const noexcept;

    std::string path_;                     ///< for messages
    std::shared_ptr<const Folder> folder_; ///< the file is in
    std::string name_;                     ///< inside the folder
    std::string unfinished_;               ///< name it is written under; empty: none
    int descriptor_ = -1;
    std::uint64_t end_ = 0;                   ///< of what was appended
    std::uint64_t reserved_ = 0;              ///< end of the room that was asked for
    std::uint64_t cached_;                    ///< as `cache_up_to()`
    std::atomic<bool> can_pass_cache_ = true; ///< until the system says that it cannot
};

/// Put files in their places that are one together, of which the last names the others: where one cannot be
/// placed, none is. The last is placed last, and one that was there before is removed first, so that it never
/// names files of two writings. A kill between the few system calls that this takes leaves some of the others
/// without it.
/// @throw BackendError
void commit_together(std::span<const std::unique_ptr<WholeFile>> files);

} // namespace lacuna::io
