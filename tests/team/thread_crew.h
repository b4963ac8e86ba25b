// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/team.h>
#include <lacuna/team/shared/tasks.h>

#include <atomic>
#include <barrier>
#include <fcntl.h>
#include <functional>
#include <thread>
#include <unistd.h>
#include <vector>

namespace lacuna::test {

/// A crew of threads, each as a process of its own would be: all it knows comes as bytes.
class ThreadCrew {
public:
    explicit ThreadCrew(int size) : size_(size), meeting_(size), said_(std::size_t(size))
    {
        for (int rank = 0; rank < size; ++rank) {
            Team& team = teams_.emplace_back();
            team.rank = rank;
            team.size = size;
            team.exchange = [this, rank](std::string own) {
                said_[std::size_t(rank)] = std::move(own);
                meeting_.arrive_and_wait();
                std::vector<std::string> all = said_;
                meeting_.arrive_and_wait();
                return all;
            };
            team.open = [this, rank](const std::string& path,
                                     const std::string&) -> std::unique_ptr<SharedFile> {
                if (rank == broken) throw BackendError("test.broken", "the disk is gone");
                if (rank == cancelled) throw Cancelled();
                return std::make_unique<File>(path);
            };
        }
        crew.size = size;
        crew.call = [this](std::string_view task, const std::string& bytes) -> const Team& {
            join();
            ++calls;
            for (int rank = 1; rank < size_; ++rank)
                helpers_.emplace_back([this, rank, name = std::string(task), bytes] {
                    RunContext context;
                    context.threads = 1;
                    try {
                        team::help(name, bytes, teams_[std::size_t(rank)], context);
                    } catch (const std::exception&) {
                        ++failed;
                    }
                });
            return teams_.front();
        };
    }
    ~ThreadCrew() { join(); }
    ThreadCrew(const ThreadCrew&) = delete;
    ThreadCrew& operator=(const ThreadCrew&) = delete;

    void join()
    {
        for (std::thread& helper : helpers_) helper.join();
        helpers_.clear();
    }

    Crew crew;
    int calls = 0;
    std::atomic<int> failed = 0;     ///< of the helpers
    int broken = -1, cancelled = -1; ///< the rank whose file is so

private:
    class File : public SharedFile {
    public:
        explicit File(const std::string& path) : file_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {}
        ~File() override { ::close(file_); }
        void write_at(std::uint64_t offset, std::string_view bytes) override
        {
            if (::pwrite(file_, bytes.data(), bytes.size(), off_t(offset)) != ssize_t(bytes.size()))
                throw BackendError("test.write", "not written");
        }
        void close() override {}

    private:
        int file_;
    };

    int size_;
    std::barrier<> meeting_;
    std::vector<std::string> said_;
    std::vector<Team> teams_;
    std::vector<std::thread> helpers_;
};

} // namespace lacuna::test
