// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/cad_protocol/shared/channel.h>
#include <lacuna/core/error.h>
#include <lacuna/core/run_context.h>

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace lacuna::cad {

/// The subject of a request, for limits and messages.
struct Task {
    std::string subject{};    ///< the file
    std::string doing{};      ///< such as "reading it" or "projecting points"
    Limits limits{};          ///< 0: derived from `bytes` and `points`
    std::uint64_t bytes = 0;  ///< size of the files sent with the request
    std::uint64_t points = 0; ///< number of points sent with the request
    const RunContext* context = nullptr;
    double grace = 0;                    ///< time that the request may continue after it is cancelled [s]
    const char* stage = "";              ///< stage that is reported as progress
    std::optional<NamedEntity> entity{}; ///< appended to `doing` in messages: "projecting points onto face 3"
};

/// The process had ended before the request was sent. Nothing was done, so another process can get the
/// request.
class WorkerGone : public BackendError {
public:
    using BackendError::BackendError;
};

/// A CAD process (lacuna-cad), started at the first request and kept.
///
/// The process may end at any time (a crash, a limit, a signal). The request in progress then fails with a
/// BackendError that says how the process ended. Later requests to this object fail with WorkerGone;
/// `current()` starts another process. A process that failed to load a file or to mesh still serves the
/// models it holds, but it loads no others. Thread-safe: requests are serialised. A child made by fork()
/// starts its own process.
class Worker {
public:
    /// The running process, started if there is none.
    /// @param subject  what the process is needed for, usually a file; for the message.
    /// @throw BackendError  "cad.no_worker": the program is not found or does not start; names the subject.
    static std::shared_ptr<Worker> current(const RunContext* context = nullptr,
                                           const std::string& subject = {});
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Send a request and wait for the reply.
    /// @throw InvalidInput, NotSweepable, BackendError  the error that the process reports.
    /// @throw BackendError  the process ended.
    /// @throw Cancelled
    template <class Reply, class Request>
    Reply ask(cad_protocol::Opcode opcode, const Request& request, const Task& task,
              const std::vector<int>& descriptors = {})
    {
        const std::string bytes = cad_protocol::encode(request);
        const std::unique_lock lock = enter(task);
        cad_protocol::Frame frame = exchange(opcode, bytes, task, descriptors);
        try {
            return cad_protocol::decode<Reply>(frame.bytes);
        } catch (const cad_protocol::ProtocolError& error) {
            give_up(task, error);
        }
    }
    /// Add the size of a model to the memory limit, until the model is released.
    void charge(std::uint64_t handle, std::uint64_t bytes);
    /// Let the process free a model or a solid, now or before the next request.
    void release(std::uint64_t handle) noexcept;

    /// Whether the process is running. If it is busy with a request, it counts as running.
    [[nodiscard]] bool lives();
    [[nodiscard]] const cad_protocol::Hello& hello() const { return hello_; }
    [[nodiscard]] pid_t pid() const { return pid_; }

private:
    explicit Worker(const RunContext* context);

    /// Check whether the process has ended by itself, and if so, clean up. @pre `busy_` is held
    void notice_end() noexcept;
    std::unique_lock<std::timed_mutex> enter(const Task& task);
    cad_protocol::Frame exchange(cad_protocol::Opcode opcode, const std::string& bytes, const Task& task,
                                 const std::vector<int>& descriptors);
    void flush_released();
    void limit_memory(std::uint64_t bytes) const;
    /// Kill the process if it is running, and record how it ended.
    /// @param why  the reason, quoted in messages of later calls; if empty, they quote the exit status.
    void end(std::string why = {}) noexcept;
    [[nodiscard]] std::string how_it_ended() const;
    [[nodiscard]] std::string last_words() const;
    [[noreturn]] void give_up(const Task& task, const cad_protocol::ProtocolError& error);
    [[noreturn]] void died(const Task& task);

    std::timed_mutex busy_; ///< held during a request
    std::unique_ptr<cad_protocol::Channel> channel_;
    cad_protocol::Descriptor process_; ///< a pidfd
    cad_protocol::Descriptor words_;   ///< file that receives the output of the process
    cad_protocol::Hello hello_;
    pid_t pid_ = 0;
    pid_t owner_ = 0;                 ///< process id of the host, which started the CAD process
    bool ended_ = false;              ///< the process ended by itself or was killed by this object; guarded
                                      ///< by `busy_`
    int status_ = 0;                  ///< exit status of the process, as from wait()
    std::string end_;                 ///< why this object killed it
    std::atomic<bool> spent_ = false; ///< loading or meshing failed, so the state of Gmsh is unknown
    std::mutex released_mutex_;
    std::vector<std::uint64_t> released_;
    std::unordered_map<std::uint64_t, std::uint64_t> charged_;
};

} // namespace lacuna::cad
