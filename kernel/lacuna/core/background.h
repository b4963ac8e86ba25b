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

/// Work that is done by a thread of its own while its maker does other work on one of the context's. With one
/// thread, or where the system gives no more, it is done when it is asked for.
///
/// The work gets a context with the threads that are left, at least one, and the same flag to cancel it. It
/// tells no progress; its notes are handed on when it is taken, so that hosts are called by one thread alone.
template <class Result>
class Background {
public:
    /// @param context  and all that `work` refers to outlive this.
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
            // done when asked for
        }
    }
    /// Waits for the work, whose result is of no use then.
    ~Background()
    {
        if (thread_.joinable()) thread_.join();
    }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Wait for the work. Once. @throw  what the work threw.
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
