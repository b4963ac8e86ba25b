// SPDX-License-Identifier: MIT
#include "program/progress_line.h"

#include <cstdio>
#include <unistd.h>

namespace lacuna::program {

namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 500ms;    // shorter work shows no progress
constexpr auto kStep = 100ms;        // between two updates, so that a slow terminal costs no time
constexpr auto kLineStep = 5s;       // between two lines if not on a terminal
constexpr double kLeastShare = 0.02; // below this fraction, the time left cannot be estimated

} // namespace

ProgressLine::ProgressLine(bool wanted) : wanted_(wanted), terminal_(isatty(STDERR_FILENO) == 1)
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
        const Clock::time_point now = Clock::now();
        if (stage_.empty()) begin_ = told_ = now;
        stage_ = stage;
        share_ = share;
        changed_.notify_all();
        return true;
    };
    options.ended = [this] {
        clear();
        expect({});
    };
    options.print = [this](std::string_view text) {
        clear();
        std::fwrite(text.data(), 1, text.size(), stdout);
        if (isatty(STDOUT_FILENO) == 1) std::fflush(stdout);
    };
}

void ProgressLine::expect(std::string_view cells)
{
    const std::lock_guard lock(mutex_);
    expected_ = cells;
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

std::string ProgressLine::text(Clock::time_point now) const
{
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, ", %.0f s", seconds(now - begin_));
    if (share_ >= kLeastShare && now > begin_) {
        const double rate = share_ / seconds(now - begin_);
        std::snprintf(numbers, sizeof numbers, " %.0f %%, %.1f %% a second, %.0f s, about %.0f s left",
                      100 * share_, 100 * rate, seconds(now - begin_), (1 - share_) / rate);
    }
    return "lacuna: " + expected_ + (expected_.empty() ? "" : ": ") + stage_ + numbers;
}

void ProgressLine::draw()
{
    std::unique_lock lock(mutex_);
    while (!ended_) {
        if (stage_.empty()) {
            changed_.wait(lock);
            continue;
        }
        const Clock::time_point now = Clock::now();
        if (terminal_ && now - begin_ >= kPatience) {
            std::fprintf(stderr, "\r\033[K%s", text(now).c_str());
            std::fflush(stderr);
            shown_ = true;
        } else if (!terminal_ && now - told_ >= kLineStep) {
            std::fprintf(stderr, "%s\n", text(now).c_str());
            told_ = now;
        }
        changed_.wait_for(lock, kStep, [this] { return ended_; });
    }
}

} // namespace lacuna::program
