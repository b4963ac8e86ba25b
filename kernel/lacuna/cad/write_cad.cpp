// SPDX-License-Identifier: MIT
#include <lacuna/cad/write_cad.h>

#include <lacuna/cad/detail/cad_files.h>
#include <lacuna/cad/detail/solid_plan.h>
#include <lacuna/closure/close.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/io/shared/units.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

namespace lacuna::cad {

using namespace topology;
using namespace cad_protocol;

namespace {

void check_sealed(const OpenVolume& volume)
{
    if (closure::is_watertight(volume)) return;
    const std::vector<EdgeId> open = free_edges(volume);
    constexpr const char* kCode = "cad.not_sealed";
    Message message = open.empty() ? Message(kCode, "the volume is not sealed: its faces enclose no space")
                                   : Message(kCode, "the volume is not sealed: {} {} free: {}",
                                             found(open.size()), open.size() == 1 ? "edge is" : "edges are",
                                             entities_of(volume.model, open));
    throw InvalidInput(std::move(message).remedy("call close() before writing it as a solid"));
}

/// Set the time stamp of a STEP file to a constant.
void forget_time(std::string& bytes)
{
    const std::size_t name = std::min(bytes.find("FILE_NAME("), bytes.size());
    const std::size_t end = std::min(bytes.find(';', name), bytes.size());
    static const std::regex kStamp("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}");
    std::cmatch stamp;
    if (std::regex_search(bytes.c_str() + name, bytes.c_str() + end, stamp, kStamp))
        bytes.replace(name + static_cast<std::size_t>(stamp.position()),
                      static_cast<std::size_t>(stamp.length()), "1970-01-01T00:00:00");
}

/// The bytes that the CAD process wrote. In a STEP file, the time stamp and the product name, which Open
/// CASCADE numbers, are replaced by constants.
std::string bytes_of(const Descriptor& file, bool step)
{
    std::string bytes = text_of(file, std::string::npos);
    if (!step) return bytes;
    forget_time(bytes);
    constexpr std::string_view kCounted = "'Open CASCADE STEP translator ";
    for (std::size_t at = bytes.find(kCounted); at != std::string::npos; at = bytes.find(kCounted, at + 1)) {
        const std::size_t end = bytes.find('\'', at + 1);
        if (end == std::string::npos) break;
        bytes.replace(at, end + 1 - at, "'volume'");
    }
    return bytes;
}

/// Declare the unit of a STEP file, which Open CASCADE writes in millimetres. The numbers stay as they are.
void state_unit(std::string& bytes, const std::string& unit)
{
    if (unit.empty() || unit == "mm") return;
    const std::string milli = "SI_UNIT(.MILLI.,.METRE.)";
    constexpr std::pair<std::string_view, std::string_view> kPrefixes[] = {
        {"um", ".MICRO."}, {"cm", ".CENTI."}, {"m", "$"}};
    const auto metric = std::ranges::find(kPrefixes, unit,
                                          &std::pair<std::string_view, std::string_view>::first);
    const std::size_t at = bytes.find(milli);
    if (at == bytes.npos)
        throw BackendError(Message("cad.step_unit",
                                   "Open CASCADE wrote a STEP file that does not declare millimetres, so "
                                   "unit = \"{}\" cannot be set",
                                   unit)
                               .remedy("write it as .brep, or with unit = \"mm\""));
    if (metric != std::end(kPrefixes)) {
        bytes.replace(at, milli.size(), formatted("SI_UNIT({},.METRE.)", metric->second));
        return;
    }
    long long highest = 0;
    for (std::size_t i = bytes.find('#'); i != bytes.npos; i = bytes.find('#', i + 1))
        highest = std::max(highest, std::atoll(bytes.c_str() + i + 1));
    // Units outside the metric system are defined by a length, here of millimetres.
    const std::size_t end = bytes.rfind("ENDSEC;");
    bytes.insert(end, formatted("#{}=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({:.17g}),#{});\n"
                                "#{}=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
                                "#{}=(LENGTH_UNIT()NAMED_UNIT(*){});\n",
                                highest + 1, 1000 * io::metres_of(unit), highest + 3, highest + 2,
                                highest + 3, milli));
    const std::size_t begin = bytes.rfind('=', at) + 1;
    bytes.replace(begin, bytes.find(';', begin) - begin,
                  formatted("(CONVERSION_BASED_UNIT('{}',#{})LENGTH_UNIT()NAMED_UNIT(#{}))",
                            unit == "in" ? "INCH" : "FOOT", highest + 1, highest + 2));
}

void check_options(const WriteCadOptions& options)
{
    if (!options.unit.empty()) io::metres_of(options.unit);
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
        throw InvalidInput("cad.tolerance",
                           "write_cad: option 'tolerance' must be a length of 0 or more, not {}",
                           found(options.tolerance));
    if (!(options.deviation > 0))
        throw InvalidInput("cad.deviation", "write_cad: option 'deviation' must be a number above 0, not {}",
                           found(options.deviation));
}

/// A solid under construction in the CAD process; released by the destructor.
struct BegunSolid {
    ~BegunSolid() { worker.release(handle); }

    Worker& worker;
    std::uint64_t handle;
};

} // namespace

WrittenCad write_cad(const OpenVolume& volume, const io::OutputPath& path, const WriteCadOptions& options,
                     const RunContext& context)
{
    check_options(options);
    const std::string ending = io::ending_of(path.text());
    if (ending != ".step" && ending != ".stp" && ending != ".brep") {
        throw InvalidInput(Message("cad.unknown_ending",
                                   "cannot write a solid to '{}': the file extension \"{}\" is not supported",
                                   path.text(), ending)
                               .remedy("use .step, .stp or .brep"));
    }
    check_sealed(volume);
    io::WholeFile file(path);
    const bool step = ending != ".brep";
    const auto in_memory = [] { return Descriptor(::memfd_create("lacuna-cad output", MFD_CLOEXEC)); };
    const Descriptor source = in_memory(), all = in_memory(), result = in_memory();

    Task task;
    task.subject = path.text();
    task.doing = "making the solid";
    task.limits = options.limits;
    task.points = volume.model.points.size();
    task.context = &context;
    task.stage = "write_cad";
    const SolidSources sources = sources_of(volume.model, context);
    const std::shared_ptr<Worker> worker = sources.worker ? sources.worker
                                                          : Worker::current(&context, task.subject);
    const auto found = worker->ask<BeginSolidReply>(
        Opcode::begin_solid,
        BeginSolidRequest{path.text(), step ? "solid.step" : "solid.brep", sources.wanted}, task,
        {source.get(), all.get(), result.get()});
    const BegunSolid begun{*worker, found.solid};
    if (found.sources.size() != sources.order.size())
        throw BackendError("cad.protocol", "{}: the CAD process did not return the files that were requested",
                           path.text());
    SolidPlan plan = plan_solid(volume, sources, found, context);

    WrittenCad written;
    written.facet_volume = closure::enclosed_volume(volume);
    written.planes = plan.planes;
    written.fitted = plan.fitted;
    MakeSolidRequest& request = plan.request;
    request.solid = found.solid;
    request.format = step ? MakeSolidRequest::step : MakeSolidRequest::brep;
    request.first_tolerance = options.tolerance > 0 ? options.tolerance : volume.model.tolerance;
    request.last_tolerance = options.tolerance > 0
                                 ? request.first_tolerance
                                 : std::max(request.first_tolerance, kVisible * volume.model.diagonal);
    request.facet_volume = written.facet_volume;
    request.deviation = options.deviation;
    const auto made = worker->ask<MakeSolidReply>(Opcode::make_solid, request, task);
    check_cancelled(context);
    written.volume = made.volume;
    written.tolerance = made.tolerance;
    written.faces = made.faces;
    std::string bytes = bytes_of(result, step);
    if (step) state_unit(bytes, options.unit);
    file.append(bytes);
    file.commit();
    return written;
}

} // namespace lacuna::cad
