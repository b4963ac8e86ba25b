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

/// A folder that is held open. It stays the same folder even if its path later leads to another.
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

/// The path of a file to be written. A plain path is resolved as the shell does; links are followed.
class OutputPath {
public:
    OutputPath(std::string path) : path_(std::move(path)) {}        // NOLINT(google-explicit-constructor)
    OutputPath(const char* path) : OutputPath(std::string(path)) {} // NOLINT(google-explicit-constructor)

    /// A path below a folder that is held open. No component may be a link or lead outside the folder.
    /// @throw InvalidInput "io.outside"  the path leads out of the folder, through `..` or a link.
    static OutputPath below(const std::shared_ptr<const Folder>& folder, const std::string& path);

    /// Another file of the same folder. @param name  one component of a path
    [[nodiscard]] OutputPath beside(const std::string& name) const;
    /// As the user gave it; its extension determines the format.
    [[nodiscard]] const std::string& text() const { return path_; }

private:
    friend class WholeFile;
    friend class WholeFolder;
    /// The folder that contains the file, and its name there. @throw InvalidInput "io.no_folder"
    [[nodiscard]] std::pair<std::shared_ptr<const Folder>, std::string> place() const;

    std::string path_;
    std::shared_ptr<const Folder> folder_; ///< null: the path is resolved when the file is opened
    std::string name_;                     ///< name of the file inside the folder
};

/// A file that appears completely or not at all.
///
/// The bytes go to a file without a name (`O_TMPFILE`), which `commit()` moves to its path. If writing ends
/// early, nothing is left behind, even if the process is killed. File systems without nameless files need a
/// temporary name next to the path, which the destructor removes. An existing file stays until commit, and
/// its mode is kept. Replacing it takes two system calls, with a temporary name in between. If the process is
/// killed between them, the complete new file stays under that hidden name until the next replacement removes
/// it.
class WholeFile {
public:
    /// Whether processes on other machines must open the file too, for which it needs a name. If the writer
    /// of a named file is killed, the file stays. The next writer of the same path removes it, at the
    /// earliest an hour after the last write.
    enum class Naming { none, named };

    /// @throw InvalidInput  the folder does not exist, or the path is not that of a file.
    /// @throw BackendError  the folder cannot be written to.
    explicit WholeFile(const OutputPath& path, Naming naming = Naming::none);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Reserve space for the bytes [begin, end), if the file system can. The file then extends to `end`.
    /// Later writes find their blocks allocated, and a full disk is reported before anything is computed.
    /// Measured for 116 MB: writing takes 24 ms instead of 33.
    /// @throw BackendError  the disk is full.
    void reserve(std::uint64_t begin, std::uint64_t end);
    /// Set the size beyond which a file bypasses the page cache, if the system supports that (Linux 6.14).
    /// The default is an eighth of the system's memory [bytes].
    void cache_up_to(std::uint64_t bytes) { cached_ = bytes; }
    /// Write bytes at an offset; several threads may do so at once.
    /// @throw BackendError  the disk is full.
    void write_at(std::uint64_t offset, std::string_view bytes);
    /// Write bytes after those appended so far.
    void append(std::string_view bytes);
    /// Path under which other processes can open the unfinished file. It is the temporary name, if there is
    /// one. Otherwise it is a path to an open file of this process, which only processes of the same user on
    /// the same machine can use.
    [[nodiscard]] std::string unfinished_path() const;
    /// Move the file to its path. @throw BackendError
    void commit();

private:
    friend void commit_together(std::span<const std::unique_ptr<WholeFile>> files);
    [[noreturn]] void fail(int error);
    ssize_t write_some(std::uint64_t offset, std::string_view bytes);
    void open_unnamed();
    void open_named();
    struct LeftOver {
        int folder;              ///< folder that contains it
        const char* name;        ///< name of the file inside the folder
        pid_t process = 0;       ///< the process that created it, according to its name
        std::time_t written = 0; ///< time of the last write [s]
    };
    /// Remove abandoned files next to the path whose names begin with `prefix`.
    void remove_left_over(const std::string& prefix,
                          const std::function<bool(const LeftOver&)>& is_left_over) const;
    void publish_unnamed();
    void remove_placed() const noexcept;

    std::string path_;                     ///< for messages
    std::shared_ptr<const Folder> folder_; ///< the folder that contains the file
    std::string name_;                     ///< name of the file inside the folder
    std::string unfinished_;               ///< temporary name; empty: none
    int descriptor_ = -1;
    std::uint64_t end_ = 0;                   ///< end of the appended bytes
    std::uint64_t reserved_ = 0;              ///< end of the reserved space
    std::uint64_t cached_;                    ///< see `cache_up_to()`
    std::atomic<bool> can_pass_cache_ = true; ///< false once the system has reported that it cannot
};

/// Move a group of files to their paths, all or none. The last file refers to the others. If it exists
/// already, it is removed first, and the new one is moved last, so that it never refers to files of two
/// different writes. If the process is killed in between, some of the other files exist without it.
/// @throw BackendError
void commit_together(std::span<const std::unique_ptr<WholeFile>> files);

} // namespace lacuna::io
