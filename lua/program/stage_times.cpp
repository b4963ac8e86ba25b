// SPDX-License-Identifier: MIT
#include "program/stage_times.h"

#include <lacuna/core/message.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <sys/resource.h>
#include <utility>

namespace lacuna::program {

namespace {

std::string quoted(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (static_cast<unsigned char>(c) < 32)
            out += ' ';
        else
            out += c;
    }
    return out + '"';
}

double seconds_of(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

double processor_seconds()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

} // namespace

void StageTimes::watch(InterpreterOptions& options)
{
    options.progress = [this, next = std::move(options.progress)](std::string_view stage, double share) {
        begin(stage);
        return !next || next(stage, share);
    };
    options.ended = [this, next = std::move(options.ended)] {
        end();
        if (next) next();
    };
}

void StageTimes::begin(std::string_view stage)
{
    if (stage == stage_) return;
    end();
    stage_ = stage;
    since_ = Clock::now();
    processor_since_ = processor_seconds();
}

void StageTimes::end()
{
    if (stage_.empty()) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - since_).count();
    auto own = std::ranges::find(stages_, stage_, &Stage::name);
    if (own == stages_.end()) own = stages_.insert(own, {stage_, 0, 0});
    own->seconds += seconds;
    own->processor_seconds += processor_seconds() - processor_since_;
    stage_.clear();
}

std::string StageTimes::to_json(const std::string& recipe, int threads) const
{
    Stage rest{"recipe", std::chrono::duration<double>(Clock::now() - start_).count(), processor_seconds()};
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    const auto times = [](const Stage& of) {
        return formatted("\"seconds\": {:.6f}, \"processor_seconds\": {:.6f}", of.seconds,
                         of.processor_seconds);
    };
    std::string text = formatted("{{\"recipe\": {}, {}, \"peak_mib\": {:.6f}, \"threads\": {}, \"stages\": [",
                                 quoted(recipe), times(rest), static_cast<double>(usage.ru_maxrss) / 1024,
                                 threads);
    const auto add = [&](const Stage& stage) {
        text += formatted("{{\"stage\": {}, {}}}", quoted(stage.name), times(stage));
    };
    for (const Stage& stage : stages_) {
        add(stage);
        text += ", ";
        rest.seconds = std::max(0.0, rest.seconds - stage.seconds);
        rest.processor_seconds = std::max(0.0, rest.processor_seconds - stage.processor_seconds);
    }
    add(rest);
    return text + "]}";
}

void StageTimes::write(const std::string& path, const std::string& recipe, int threads) const
{
    const std::string text = to_json(recipe, threads) + "\n";
    std::FILE* const file = path == "-" ? stderr : std::fopen(path.c_str(), "w");
    bool written = file != nullptr && std::fputs(text.c_str(), file) >= 0;
    if (file != nullptr && file != stderr) written = std::fclose(file) == 0 && written;
    if (!written) throw std::runtime_error("--timing cannot write '" + path + "': " + std::strerror(errno));
}

} // namespace lacuna::program
