// SPDX-License-Identifier: MIT
// A program in place of lacuna-cad that misbehaves as CSF_FAKE says.
#include <lacuna/cad_protocol/shared/channel.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <random>

#include <unistd.h>

using namespace lacuna;
using namespace cad_protocol;

namespace {

LoadReply triangle()
{
    LoadReply reply;
    reply.model = 1;
    reply.diagonal = 1;
    reply.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    reply.vertex_tags = {1, 2, 3};
    for (int k = 0; k < 3; ++k)
        reply.edges.push_back({k + 1, k + 1, k, (k + 1) % 3, {0, 1}, {k, (k + 1) % 3}});
    reply.faces.push_back({1, "face", "plane", {{0, 1, 2}}, {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}}});
    reply.solids = {{1, "", {0}}};
    return reply;
}

Failure refusal()
{
    const Message message = Message("cad.fake", "{} of {{}} has {} sides, not {}",
                                    NamedEntity{"face", 3, "lid"}, found(7), needed(8))
                                .remedy("split {}", NamedEntity{"edge", 4, {}, std::pair(1, 2)});
    return {Failure::invalid_input, message.parts()};
}

void write_raw(const std::string& bytes)
{
    if (::write(3, bytes.data(), bytes.size()) < 0) ::_exit(1);
}

/// A frame's head with any content.
std::string head(std::uint16_t version, std::uint16_t opcode, std::uint64_t descriptors, std::uint64_t length)
{
    Writer writer;
    writer(std::uint32_t{0x4443414c});
    writer(version), writer(opcode), writer(descriptors), writer(length);
    return std::move(writer).take();
}

} // namespace

int main()
{
    const char* told = std::getenv("CSF_FAKE");
    const std::string how = told != nullptr ? told : "";
    if (how == "ends") return 3;
    if (how == "garbage") write_raw(std::string(4096, 'x'));
    if (how == "version") write_raw(head(99, 1, 0, 0));
    Channel channel{Descriptor(3)};
    try {
        channel.send(Opcode::hello, encode(Hello{"fake", ""}));
        if (how == "deaf") ::sleep(1000);
        std::mt19937 dice(static_cast<unsigned>(std::chrono::steady_clock::now().time_since_epoch().count()));
        for (;;) {
            const Frame request = channel.receive();
            if (request.opcode == Opcode::evaluate) {
                const auto asked = decode<EvaluateRequest>(request.bytes);
                std::string bytes = encode(
                    EvaluateReply{std::vector<Vec3>(asked.params.size(), Vec3(1, 0, 0))});
                if (dice() % 4 == 0) bytes[dice() % bytes.size()] = char(dice());
                channel.send(Opcode::done, bytes);
            }
            if (request.opcode != Opcode::load) continue;
            LoadReply reply = triangle();
            if (how == "silent") continue;
            if (how == "length") write_raw(head(1, 3, 0, std::uint64_t{1} << 60));
            if (how == "descriptors") write_raw(head(1, 3, 7, 0));
            if (how == "half") {
                write_raw(head(1, 3, 0, 1 << 20));
                return 0;
            }
            if (how == "opcode") channel.send(Opcode::hello, {});
            if (how == "indices") reply.faces[0].triangles[0][1] = 1'000'000;
            if (how == "edges") reply.edges[0].points = {2, 1};
            if (how == "form") reply.edges[0].form = {Vec3(0, 0, 0)};
            if (how == "solids") reply.solids = {{1, "", {-1}}};
            if (how == "nan") reply.points[0].x() = std::numeric_limits<double>::quiet_NaN();
            const bool refuses = how == "refuses" || (how == "noise" && dice() % 2 == 0);
            std::string bytes = refuses ? encode(refusal()) : encode(reply);
            if (how == "text") bytes.replace(bytes.find("face") - 8, 8, 8, '\x7f');
            if (how == "noise") {
                for (int k = 0; k < 1 + int(dice() % 4); ++k) bytes[dice() % bytes.size()] = char(dice());
                if (dice() % 3 == 0) bytes.resize(dice() % bytes.size());
            }
            channel.send(refuses ? Opcode::failed : Opcode::done, bytes);
        }
    } catch (const ProtocolError&) {
    }
}
