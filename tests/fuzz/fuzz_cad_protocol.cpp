// SPDX-License-Identifier: MIT
//
// Bytes as a message between the kernel and the CAD process; the first says which. A message that is
// understood is written again as it came; any other is a ProtocolError. Without libFuzzer:
// fuzz_cad_protocol [SECONDS [SEED]]
#include <lacuna/cad_protocol/shared/messages.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

using namespace lacuna;
using namespace cad_protocol;

namespace {

template <class T>
void read(std::string_view bytes)
{
    try {
        if (encode(decode<T>(bytes)) != bytes) std::abort();
    } catch (const ProtocolError&) {
    }
}

constexpr int kMessages = 18;

void read_as(int which, std::string_view bytes)
{
    using Read = void (*)(std::string_view);
    constexpr Read kReads[kMessages] = {
        read<Hello>,           read<Progress>,         read<Failure>,        read<LoadRequest>,
        read<LoadReply>,       read<EvaluateRequest>,  read<EvaluateReply>,  read<ProjectRequest>,
        read<ProjectReply>,    read<RecombineRequest>, read<RecombineReply>, read<BeginSolidRequest>,
        read<BeginSolidReply>, read<MakeSolidRequest>, read<MakeSolidReply>, read<ReleaseRequest>,
        read<FillSkinRequest>, read<FillSkinReply>};
    kReads[which % kMessages](bytes);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size > 0) read_as(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
    return 0;
}

#ifndef LACUNA_FUZZ

namespace {

std::string sample(int which)
{
    LoadReply model;
    model.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    model.vertex_tags = {1, 2, 3};
    for (int k = 0; k < 3; ++k) model.edges.push_back({k, k, k, (k + 1) % 3, {0, 1}, {k, (k + 1) % 3}});
    model.edges[0].form = {{0, 0, 0}, {1, 0, 0}};
    model.edges[1].form = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    model.faces.push_back({1, "face", "plane", {{0, 1, 2}}, {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}}});
    model.solids = {{1, "part", {0}}};
    const SplineAxisData axis{1, {0, 1}, {2, 2}};
    MakeSolidRequest solid;
    solid.points = model.points;
    solid.edges = {{SolidEdge::lines, -1, 0, {0, 1}, {}},
                   {SolidEdge::spline, -1, 0, {}, {axis, {Vec3(0, 0, 0), Vec3(1, 1, 1)}}}};
    solid.faces = {{SolidFace::plane, NamedEntity{"face", 1}, -1, 0, {{{0, 1}, {1, 0}}}, {}, {}, 0},
                   {SolidFace::patches,
                    NamedEntity{"void face", 2, "lid"},
                    -1,
                    0,
                    {},
                    {{axis, axis, std::vector<Vec3>(4, Vec3::Ones())}},
                    {2},
                    1}};
    solid.first_tolerance = solid.last_tolerance = 1;
    RecombineRequest region{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}, {{0, 1, 2, 3}}, {}};
    region.size.columns = 2;
    region.size.sizes = {1, 1, 1, 1};
    switch (which % kMessages) {
    case 0:
        return encode(Hello{"4.8.4", "Landlock"});
    case 1:
        return encode(Progress{0.5});
    case 2:
        return encode(Failure{Failure::backend,
                              {"cad.gmsh",
                               "words",
                               "try this",
                               {{"face", 3, "lid"}, {"edge", 4, {}, std::pair(1, 2)}},
                               {1LL, 0.5},
                               {"text"}}});
    case 3:
        return encode(LoadRequest{{{LoadFile::step, "a/b.step", {{"b.step"}, {"c"}}}}, 0, 1});
    case 4:
        return encode(model);
    case 5:
        return encode(EvaluateRequest{1, 2, {0, 0.5, 1}});
    case 6:
        return encode(EvaluateReply{model.points});
    case 7:
        return encode(ProjectRequest{1, 2, {Vec3(1, 2, 3)}, {Vec2(1, 2)}});
    case 8:
        return encode(ProjectReply{{Vec3(1, 2, 3)}, {Vec2(1, 2)}});
    case 9:
        return encode(region);
    case 10:
        return encode(RecombineReply{region.points, {{0, 1, 2, 3}}});
    case 11:
        return encode(BeginSolidRequest{"a.step", "solid.step", {{1, {1, 2}, {3}}}});
    case 12:
        return encode(BeginSolidReply{1, {{{1, 2}, {3}, {{}}}}});
    case 13:
        return encode(solid);
    case 14:
        return encode(MakeSolidReply{1, 2, 3});
    case 15:
        return encode(ReleaseRequest{1});
    case 16:
        return encode(FillSkinRequest{model.points, {{{0, 1, 2}}, {{2, 1, 0}, {0, 1, 2}}}});
    default:
        return encode(FillSkinReply{std::vector<Vec3>(4, Vec3::Ones()), {{0, 1, 2, 3}}});
    }
}

} // namespace

int main(int argc, char** argv)
{
    const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 1;
    std::mt19937_64 dice(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : dice() % n; };
    const auto start = std::chrono::steady_clock::now();
    std::size_t runs = 0;
    for (; std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds;
         ++runs) {
        const auto which = static_cast<int>(below(kMessages));
        // A sample as it is is understood, so mutations begin at something.
        std::string bytes = sample(which);
        if (encode(decode<Hello>(sample(0))) != sample(0)) return 1;
        for (std::size_t k = below(5); k > 0; --k) {
            const std::size_t at = below(bytes.size());
            switch (below(5)) {
            case 0:
                bytes.insert(at, below(12), static_cast<char>(dice()));
                break;
            case 1:
                bytes.erase(at, 1 + below(12));
                break;
            case 2:
                bytes.replace(at, std::min<std::size_t>(8, bytes.size() - at), 8, static_cast<char>(0xff));
                break;
            case 3:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(64)));
                break;
            default:
                if (!bytes.empty())
                    bytes[at] = static_cast<char>(below(2) == 0 ? dice() : bytes[at] ^ (1 << below(8)));
            }
        }
        bytes.insert(bytes.begin(), static_cast<char>(which));
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::printf("%zu runs\n", runs);
}

#endif
