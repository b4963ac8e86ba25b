// SPDX-License-Identifier: MIT
#pragma once

// In: a host's settings for a computation; out: the threads, errors, messages and ids that every folder
// uses.
//
// Where to change things:
//   number of threads, cancelling, log lines   run_context.cpp
//   parallel loop; one job beside the caller   parallel.cpp, shared/background.h
//   work shared by several processes           team.cpp
//   classes of errors; what a message names    error.h, message.h
//   text of a message; numbers in messages     message_text.cpp, number_text.cpp
//   limits that several folders share          shared/criteria.h
//   labels that CAD programs write by default  default_labels.cpp
//   bytes sent between processes               shared/bytes.h
//   code for several instruction sets          shared/vector_code.h

#include <atomic>
#include <functional>
#include <string_view>

namespace lacuna {

/// How a computation runs: threads, cancelling, log and progress. All members have working defaults. The flag
/// that `cancel` points to belongs to the host.
struct RunContext {
    int threads = 0;                                        ///< 0 or less: all cores; see thread_count()
    const std::atomic<bool>* cancel = nullptr;              ///< set by the host to stop the work
    std::function<void(std::string_view)> log;              ///< receives notes for a person, one line each
    std::function<void(std::string_view, double)> progress; ///< stage, fraction in [0, 1]
};

/// @throw Cancelled  the host asked to stop.
void check_cancelled(const RunContext& context);

/// Number of threads to use: at least 1, at most the larger of 64 and the number of cores.
int thread_count(const RunContext& context);

/// Pass a line to the log of the context, if there is one.
void log_line(const RunContext& context, std::string_view line);

} // namespace lacuna
