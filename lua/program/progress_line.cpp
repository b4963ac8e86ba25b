// SPDX-License-Identifier: MIT
#include "program/progress_line.h"

#include <cstdio>
#include <unistd.h>

namespace lacuna::program {

namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 500ms; // shorter work shows nothing: a choice, not a measurement
constexpr auto kStep = 100ms;     // between two drawings, so that a slow terminal costs no time

} // namespace

ProgressLine::ProgressLine(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1)
{
    if (wanted_) thread_ = std::thread([this] { draw(); });
}

ProgressLine::~ProgressLine()
{
    if (!wanted_) return;
    clear();
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void ProgressLine::watch(InterpreterOptions& options)
{
    if (!wanted_) return;
    options.progress = [this](std::string_view stage, double share) {
        const std::lock_guard lock(mutex_);
        if (stage_.empty()) begin_ = Clock::now();
        stage_ = stage;
        share_ = share;
        changed_.notify_all();
        return true;
    };
    options.print = [this](std::string_view text) {
        clear();
        std::fwrite(text.data(), 1, text.size(), stdout);
        if (isatty(STDOUT_FILENO) == 1) std::fflush(stdout);
    };
}

void ProgressLine::erase()
{
    if (!shown_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
}

void ProgressLine::clear()
{
    const std::lock_guard lock(mutex_);
    stage_.clear();
    erase();
}

void ProgressLine::draw()
{
    std::unique_lock lock(mutex_);
    while (!ended_) {
        if (stage_.empty()) {
            changed_.wait(lock);
            continue;
        }
        const auto taken = Clock::now() - begin_;
        if (taken >= kPatience) {
            const double seconds = std::chrono::duration<double>(taken).count();
            std::fprintf(stderr, "\r\033[Klacuna: %s", stage_.c_str());
            if (share_ > 0) std::fprintf(stderr, " %.0f %%", 100 * share_);
            std::fprintf(stderr, ", %.0f s", seconds);
            std::fflush(stderr);
            shown_ = true;
        }
        changed_.wait_for(lock, kStep, [this] { return ended_; });
    }
}

} // namespace lacuna::program
