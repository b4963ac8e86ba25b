// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace lacuna {

/// A job that runs on its own thread while the thread that started it continues. If the context allows one
/// thread only, or the system cannot create a thread, the job runs inside `take()`.
///
/// The job gets a context of its own: with the remaining threads (at least one) and the cancel flag of the
/// given context, but without progress. Lines that the job logs are collected, and `take()` passes them on,
/// so that the host is called from one thread only.
template <class Result>
class Background {
public:
    /// @param context  must outlive this object, as must everything that `work` refers to.
    Background(const RunContext& context, std::function<Result(const RunContext&)> work)
        : context_(context), work_(std::move(work))
    {
        const int threads = thread_count(context);
        if (threads == 1) return;
        own_.threads = std::max(threads - 1, 1);
        own_.cancel = context.cancel;
        own_.log = [this](std::string_view line) { notes_.emplace_back(line); };
        try {
            thread_ = std::thread([this] { run(); });
        } catch (const std::system_error&) {
            // take() runs the job
        }
    }
    /// Waits for the job and discards its result.
    ~Background()
    {
        if (thread_.joinable()) thread_.join();
    }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Wait for the job and return its result. Call once. @throw  whatever the job threw.
    Result take()
    {
        if (!thread_.joinable()) return work_(context_);
        thread_.join();
        for (const std::string& note : notes_) log_line(context_, note);
        if (failure_) std::rethrow_exception(failure_);
        return std::move(*result_);
    }

private:
    void run()
    {
        try {
            result_ = work_(own_);
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    const RunContext& context_;
    std::function<Result(const RunContext&)> work_;
    RunContext own_;
    std::vector<std::string> notes_;
    std::optional<Result> result_;
    std::exception_ptr failure_;
    std::thread thread_;
};

} // namespace lacuna
