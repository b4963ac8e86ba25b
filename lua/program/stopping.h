// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <atomic>

namespace lacuna::program {

/// Exit codes of the program.
enum class Exit { done = 0, failed = 1, bad_usage = 2, interrupted = 130, terminated = 143 };

// --- stopping: set by signals, which reach nothing but globals ------------------------------------------

/// Ctrl-C, SIGTERM, SIGHUP and the alarm cancel `interpreter` from now on, and a second one ends the process,
/// a Ctrl-C where it comes a second later or more; null: Ctrl-C ends it at once.
void watch_interrupts(Interpreter* interpreter);
/// The same signals set `cancel`, of a process that runs no recipe; it outlives them.
void watch_interrupts(std::atomic<bool>& cancel);
/// What a run ended by, which was cancelled; `seconds` is the time limit. Writes to standard error, and
/// forgets the request.
Exit report_stop(double seconds);

/// Nothing runs from here to end_idle(): Ctrl-C stops nothing, and the other signals end the process.
void begin_idle();
/// Whether Ctrl-C came meanwhile.
bool end_idle();

/// Tell an error on standard error, with the traceback it may have.
void report(const ScriptError& error);

/// Limit the process: memory by its data segment, time by an alarm that asks first and later ends
/// the process.
void limit_process(double megabytes, double seconds);

} // namespace lacuna::program
