// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/cad_files.h>

#include <lacuna/cad/detail/input_file.h>
#include <lacuna/core/shared/list_text.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace lacuna::cad {

using namespace cad_protocol;

std::string subject_of(const CadOrder& order) { return full_list(order.paths, std::identity()); }

CadFiles open_cad_files(const CadOrder& order, const RunContext& context)
{
    CadFiles files;
    files.request.tolerance = order.tolerance;
    files.request.scale = order.scale;
    for (const std::string& path : order.paths) {
        InputFile input = open_input(path, context);
        files.bytes += input.bytes;
        for (const std::uint64_t digest : input.digests) files.digest = digest_of(digest, files.digest);
        std::ranges::move(input.notes, std::back_inserter(files.notes));
        files.request.files.push_back(std::move(input.file));
        for (Descriptor& file : input.descriptors) files.descriptors.push_back(std::move(file));
    }
    return files;
}

LoadReply read_cad_files(Worker& worker, const CadOrder& order, const CadFiles& files,
                         const RunContext& context)
{
    Task task{subject_of(order), "reading it", order.limits};
    task.bytes = files.bytes;
    task.context = &context;
    task.stage = "load";
    std::vector<int> descriptors;
    for (const Descriptor& file : files.descriptors) descriptors.push_back(file.get());
    auto reply = worker.ask<LoadReply>(Opcode::load, files.request, task, descriptors);
    worker.charge(reply.model, files.bytes);
    return reply;
}

} // namespace lacuna::cad
