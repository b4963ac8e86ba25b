// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/input_file.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/large_pages.h>

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lacuna::io {
namespace {

/// A plain file opened for reading, closed with the object.
class InputFile {
public:
    explicit InputFile(const std::string& path)
    {
        // Without O_NONBLOCK, opening a pipe would block until another process writes to it.
        descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
        if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
            throw InvalidInput(
                Message("io.no_file", "there is no file {}", path).remedy("check the name and the folder"));
        if (descriptor_ < 0)
            throw InvalidInput("io.no_file", "cannot open {}: {}", path,
                               std::generic_category().message(errno));
        struct stat about {};
        if (::fstat(descriptor_, &about) != 0)
            refuse({"io.no_file", "the status of {} cannot be read", path});
        if (S_ISDIR(about.st_mode))
            refuse(Message("io.not_a_file", "{} is a folder", path).remedy("name a file in it"));
        if (!S_ISREG(about.st_mode))
            refuse(Message("io.not_a_file", "{} is a pipe or a device, not a plain file", path)
                       .remedy("copy it to a file"));
        if (about.st_size == 0)
            refuse(Message("io.empty_file", "{} is empty", path).remedy("export it again"));
        bytes_ = static_cast<std::size_t>(about.st_size);
    }
    ~InputFile() { ::close(descriptor_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] std::string read(const std::string& path) const
    {
        std::string data;
        data.reserve(bytes_);
        use_large_pages(data.data(), bytes_);
        data.resize(bytes_);
        std::size_t done = 0;
        while (done < data.size()) {
            const ssize_t part = ::read(descriptor_, data.data() + done, data.size() - done);
            if (part < 0 && errno == EINTR) continue;
            if (part < 0)
                throw BackendError("io.read_failed", "reading {} failed: {}", path,
                                   std::generic_category().message(errno));
            if (part == 0) break;
            done += static_cast<std::size_t>(part);
        }
        data.resize(done);
        return data;
    }

private:
    [[noreturn]] void refuse(const Message& why)
    {
        ::close(descriptor_);
        throw InvalidInput(why);
    }

    int descriptor_ = -1;
    std::size_t bytes_ = 0;
};

} // namespace

void check_file(const std::string& path) { const InputFile file(path); }

std::string read_file(const std::string& path) { return InputFile(path).read(path); }

} // namespace lacuna::io
