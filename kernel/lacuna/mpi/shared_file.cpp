// SPDX-License-Identifier: MIT
#include <lacuna/mpi/detail/shared_file.h>

#include <mpi.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace lacuna::mpi {
namespace {

class File : public SharedFile {
public:
    File(const std::string& path, std::string name) : name_(std::move(name))
    {
        // Each process opens the file on its own (MPI_COMM_SELF). If one process cannot open it, the others
        // need not wait.
        check(MPI_File_open(MPI_COMM_SELF, path.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file_),
              "every process must see the folder");
    }
    ~File() override
    {
        if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
    }

    void write_at(std::uint64_t offset, std::string_view bytes) override
    {
        const std::lock_guard<std::mutex> hold(lock_); // MPI must be called by one thread at a time
        while (!bytes.empty()) {
            const std::size_t count = std::min(bytes.size(), kMostAtOnce);
            MPI_Status status;
            check(MPI_File_write_at(file_, static_cast<MPI_Offset>(offset), bytes.data(),
                                    static_cast<int>(count), MPI_BYTE, &status),
                  "");
            int written = 0;
            MPI_Get_count(&status, MPI_BYTE, &written);
            if (written <= 0) fail("no space left on the disk", "free some, or write to another");
            offset += static_cast<std::uint64_t>(written);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void close() override { check(MPI_File_close(&file_), ""); }

private:
    void check(int code, const char* remedy) const
    {
        if (code == MPI_SUCCESS) return;
        char text[MPI_MAX_ERROR_STRING];
        int length = 0;
        MPI_Error_string(code, text, &length);
        fail({text, static_cast<std::size_t>(length)}, remedy);
    }
    [[noreturn]] void fail(std::string_view why, const char* remedy) const
    {
        throw BackendError(
            Message("io.write_failed", "cannot write '{}': {}. No partial file was left", name_, why)
                .remedy("{}", remedy));
    }

    std::string name_;
    MPI_File file_ = MPI_FILE_NULL;
    std::mutex lock_;
};

} // namespace

std::unique_ptr<SharedFile> open_shared(const std::string& path, const std::string& name)
{
    return std::make_unique<File>(path, name);
}

} // namespace lacuna::mpi
