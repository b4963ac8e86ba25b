// SPDX-License-Identifier: MIT
//
// Mutates samples and hands them to a harness: bytes flipped, numbers replaced, pieces dropped, doubled,
// swapped and cut, two samples joined. The seed decides everything. Memory and time of every run are bounded.
#include "fuzz/counted_new.h"
#include "support/facet_files.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

extern "C" const char* const kFuzzEnding;
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostBytes = 200'000; // of a sample: more runs matter more than long ones
constexpr std::size_t kMemory = 20;         // bytes held for each byte of the file
constexpr std::size_t kMemoryOfAny = 1 << 17;
constexpr double kSecondsOfRun = 5; // of a file of kMostBytes, under sanitizers too

const char* const kNumbers[] = {"0",
                                "-1",
                                "1",
                                "2147483647",
                                "-2147483648",
                                "4294967296",
                                "1e308",
                                "-1e-320",
                                "nan",
                                "inf",
                                "9999999999999999999999",
                                "1+5",
                                "1.5D300",
                                "0x10",
                                "",
                                "99999999",
                                "3",
                                "*",
                                "1000000000",
                                "18446744073709551615"};

std::string read(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Arguments {
    std::uint64_t runs = ~std::uint64_t(0);
    double seconds = 1e9;
    std::uint64_t seed = 1;
    std::vector<fs::path> files;
};

void add_samples(const fs::path& path, std::vector<std::string>& samples)
{
    const auto add = [&](const fs::path& file) {
        std::string ending = file.extension().string();
        for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (ending == kFuzzEnding) samples.push_back(read(file).substr(0, kMostBytes));
    };
    std::error_code error;
    if (fs::is_directory(path, error))
        for (const auto& entry : fs::directory_iterator(path)) add(entry.path());
    else if (fs::exists(path, error))
        add(path);
}

class Mutator {
public:
    Mutator(std::uint64_t seed, const std::vector<std::string>& samples) : random_(seed), samples_(samples) {}

    std::string next()
    {
        std::string bytes = samples_[below(samples_.size())];
        for (std::size_t k = 1 + below(4); k > 0; --k) mutate(bytes);
        if (bytes.size() > 2 * kMostBytes) bytes.resize(2 * kMostBytes);
        return bytes;
    }

private:
    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

    /// A place where a line or word begins, more often than not.
    std::size_t place(const std::string& bytes)
    {
        const std::size_t at = below(bytes.size() + 1);
        if (below(4) == 0) return at;
        const std::size_t found = bytes.find_first_of(below(2) == 0 ? "\n" : " ,\"", at);
        return found == std::string::npos ? at : found + 1;
    }

    void mutate(std::string& bytes)
    {
        const std::size_t a = place(bytes);
        const std::size_t b = place(bytes);
        const std::size_t from = std::min(a, b);
        const std::size_t length = std::min<std::size_t>(std::max(a, b) - from, below(3) == 0 ? 5000 : 60);
        switch (below(9)) {
        case 0:
            if (!bytes.empty()) bytes[below(bytes.size())] = static_cast<char>(random_());
            break;
        case 1:
            if (!bytes.empty()) bytes[below(bytes.size())] ^= static_cast<char>(1 << below(8));
            break;
        case 2: { // a number, or what follows, replaced
            const std::size_t end = std::min(bytes.find_first_of(" \n,\"", from), bytes.size());
            bytes.replace(from, end - from, kNumbers[below(std::size(kNumbers))]);
            break;
        }
        case 3:
            bytes.erase(from, length);
            break;
        case 4:
            bytes.insert(place(bytes), bytes.substr(from, length));
            break;
        case 5:
            bytes.resize(from);
            break;
        case 6: { // eight bytes of another size
            const std::uint64_t values[] = {0, ~std::uint64_t(0), std::uint64_t(1) << 62, 0x7fffffff,
                                            1, random_()};
            const std::uint64_t value = values[below(std::size(values))];
            const std::size_t width = below(2) == 0 ? 4 : 8;
            if (bytes.size() >= width)
                std::memcpy(bytes.data() + below(bytes.size() - width + 1), &value, width);
            break;
        }
        case 7: { // another sample's piece
            const std::string& other = samples_[below(samples_.size())];
            const std::size_t begin = below(other.size() + 1);
            bytes.insert(from, other.substr(begin, below(2) == 0 ? 80 : 4000));
            break;
        }
        default: { // two pieces swapped
            const std::string piece = bytes.substr(from, length);
            bytes.erase(from, length);
            bytes.insert(place(bytes), piece);
        }
        }
    }

    std::mt19937_64 random_;
    const std::vector<std::string>& samples_;
};

/// The bytes at work, kept where a run ends the program or takes too much.
void keep(const std::string& bytes)
{
    const std::string path = (fs::temp_directory_path() / (std::string("fuzz_found") + kFuzzEnding)).string();
    std::ofstream(path, std::ios::binary) << bytes;
    std::fprintf(stderr, "kept in %s\n", path.c_str());
}

const std::string* at_work = nullptr;
void keep_at_work(int signal)
{
    std::signal(signal, SIG_DFL);
    keep(*at_work);
    std::raise(signal);
}

/// Nothing where the words are not understood.
std::optional<Arguments> read_arguments(int count, char** words)
{
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto value = [&] { return i + 1 < count ? words[++i] : "0"; };
        if (word == "--runs")
            arguments.runs = std::strtoull(value(), nullptr, 10);
        else if (word == "--seconds")
            arguments.seconds = std::strtod(value(), nullptr);
        else if (word == "--seed")
            arguments.seed = std::strtoull(value(), nullptr, 10);
        else if (word == "--shared")
            for (const char* folder : {"hostile", "fem", "stl"})
                arguments.files.push_back(fs::path(LACUNA_SOURCE_DIR) / "../shared/data" / folder);
        else if (word.starts_with("-"))
            return std::nullopt;
        else
            arguments.files.emplace_back(word);
    }
    return arguments;
}

} // namespace

int main(int count, char** words)
{
    const std::optional<Arguments> read_words = read_arguments(count, words);
    if (!read_words) {
        std::fprintf(stderr,
                     "usage: %s [--runs N] [--seconds S] [--seed N] [--shared] [FILE or FOLDER...]\n"
                     "without --runs and --seconds it runs until it is stopped\n",
                     words[0]);
        return 2;
    }
    const Arguments& arguments = *read_words;
    std::vector<std::string> samples;
    for (const auto& sample : lacuna::test::facet_samples()) {
        std::string ending = fs::path(sample.name).extension().string();
        for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (ending == ".nas" || ending == ".dat") ending = ".bdf";
        if (ending == kFuzzEnding) samples.push_back(sample.bytes);
    }
    for (const fs::path& path : arguments.files) add_samples(path, samples);
    Mutator mutator(arguments.seed, samples);
    const auto start = Clock::now();
    const auto seconds = [](Clock::time_point since) {
        return std::chrono::duration<double>(Clock::now() - since).count();
    };
    std::signal(SIGABRT, keep_at_work);
    std::signal(SIGSEGV, keep_at_work);
    std::uint64_t runs = 0;
    for (; runs < arguments.runs && seconds(start) < arguments.seconds; ++runs) {
        const std::string bytes = runs < samples.size() ? samples[runs] : mutator.next();
        at_work = &bytes;
        const std::size_t before = lacuna::fuzz::held();
        lacuna::fuzz::count_most_anew();
        const auto begin = Clock::now();
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
        const std::size_t memory = lacuna::fuzz::most_held() - before;
        if (memory > kMemory * bytes.size() + kMemoryOfAny || seconds(begin) > kSecondsOfRun) {
            std::fprintf(stderr, "run %llu took %zu bytes and %.1f s for %zu bytes\n",
                         static_cast<unsigned long long>(runs), memory, seconds(begin), bytes.size());
            keep(bytes);
            return 1;
        }
    }
    std::printf("%s: %llu runs of %zu samples, %.1f s\n", kFuzzEnding, static_cast<unsigned long long>(runs),
                samples.size(), seconds(start));
    return 0;
}
