// Reader of extended OBJ: the table of #mvs lines, and those of the whole file and its state.
#include <cmath>

#include "formats/obj/reader.h"
#include "history/event_limits.h"

namespace mvs::core {

void ObjReader::record(Line &line) {
  struct Record {
    std::string_view word;
    void (ObjReader::*read)(Line &);
  };
  static constexpr std::array records = {Record{"fibre", &ObjReader::fibre},
                                         Record{"rest", &ObjReader::rest},
                                         Record{"velocity", &ObjReader::velocity},
                                         Record{"loaded", &ObjReader::loaded},
                                         Record{"open", &ObjReader::open},
                                         Record{"origin", &ObjReader::origin},
                                         Record{"ring", &ObjReader::ring},
                                         Record{"ring_point", &ObjReader::ring_point},
                                         Record{"curve", &ObjReader::curve},
                                         Record{"curve_point", &ObjReader::curve_point},
                                         Record{"thickness", &ObjReader::thickness},
                                         Record{"chord", &ObjReader::chord},
                                         Record{"annulus", &ObjReader::annulus},
                                         Record{"head", &ObjReader::head},
                                         Record{"scallop", &ObjReader::scallop},
                                         Record{"leaflet", &ObjReader::leaflet},
                                         Record{"state", &ObjReader::state},
                                         Record{"valve", &ObjReader::valve},
                                         Record{"solver_cache", &ObjReader::solver_cache},
                                         Record{"solver_cache_data", &ObjReader::solver_cache_data},
                                         Record{"end", &ObjReader::end}};
  ++counts_.records;
  const std::string_view word = line.word();
  if (!has_version_) return version(word, line);
  for (const Record &candidate : records) {
    if (candidate.word == word) return (this->*candidate.read)(line);
  }
  line.fail("#mvs %s is not known in version %u of the format", quoted(word).c_str(), obj::version);
}

// `#mvs 1 units=mm`, the first record.
void ObjReader::version(std::string_view word, Line &line) {
  uint64_t number = 0;
  if (!parse_whole(word, number)) {
    line.fail("the first #mvs line has to be `#mvs %u units=mm`, not #mvs %s", obj::version,
              quoted(word).c_str());
  }
  if (number != obj::version) {
    throw Error(MVS_E_VERSION, "",
                format("the file has version %s, this libmvs reads version %u",
                       quoted(word).c_str(), obj::version),
                line.number_of_line());
  }
  if (counts_.vertices + counts_.faces + counts_.lines > 0) {
    line.fail("this line has to stand above the first v, f and l line");
  }
  has_version_ = true;
  static constexpr std::array<std::string_view, 1> units = {"mm"};
  uint32_t unit = 0;
  Fields fields(line);
  fields.need(fields.choice("units", unit, units), "units");
  fields.end();
}

void ObjReader::valve(Line &line) {
  once(has_valve_, "#mvs valve", line);
  Valve &valve = out_.valve;
  Fields fields(line);
  fields.text("name", valve.name);
  fields.whole("next_id", valve.next_id);
  fields.number("density", valve.density);
  fields.number("contact_thickness", valve.contact_thickness, obj::mm);
  fields.number("contact_stiffness", valve.contact_stiffness);
  fields.number("bending_scale", valve.bending_scale);
  fields.end();
}

void ObjReader::state(Line &line) {
  once(has_state_, "#mvs state", line);
  State &state = out_.state;
  Fields fields(line);
  fields.number("time", state.time);
  fields.whole("steps", state.steps);
  fields.number("pressure", state.load.pressure);
  fields.number("boundary_fraction", state.load.boundary_fraction);
  fields.number("rest_tolerance", state.rest_tolerance);
  fields.whole("tools_made", state.tools_made);
  fields.end();
  if (!(std::abs(state.load.pressure) <= limits::pressure)) {
    line.fail("pressure is %g Pa: it has to be within %g Pa", state.load.pressure,
              limits::pressure);
  }
  if (!(state.load.boundary_fraction >= 0 && state.load.boundary_fraction <= 1)) {
    line.fail("boundary_fraction is %g: it has to be 0 (open) to 1 (loaded)",
              state.load.boundary_fraction);
  }
  if (!(state.rest_tolerance >= 0 && state.rest_tolerance <= limits::residual.most)) {
    line.fail("rest_tolerance is %g: it has to be a force of at most %g N, or 0",
              state.rest_tolerance, limits::residual.most);
  }
  constexpr uint64_t most_made = 1'000'000'000'000;  // leaves room for the ids of all others
  if (state.tools_made > most_made) {
    line.fail("tools_made is %llu: it has to be the number of all tools that the valve ever had",
              static_cast<unsigned long long>(state.tools_made));
  }
}

void ObjReader::solver_cache(Line &line) {
  if (cache_size_ > 0) line.fail("#mvs solver_cache is given twice");
  SolverCache &cache = out_.state.cache;
  uint64_t version = 0;
  Fields fields(line);
  fields.need(fields.whole("version", version), "version");
  fields.need(fields.whole("counter", cache.counter), "counter");
  fields.need(fields.whole("size", cache_size_), "size");
  fields.end();
  if (version > UINT32_MAX) line.fail("version is too large");
  if (cache_size_ == 0) line.fail("size is 0: a state without a cache has no such line");
  cache.version = static_cast<uint32_t>(version);
}

void ObjReader::solver_cache_data(Line &line) {
  CowVector<double> &data = out_.state.cache.data;
  while (!line.at_end()) {
    if (data.size() >= cache_size_) {
      line.fail("the solver cache has more numbers than the %llu of its `#mvs solver_cache` line",
                static_cast<unsigned long long>(cache_size_));
    }
    data.push_back(line.number());
  }
}

void ObjCounts::check(Fields &fields, const Line &line) const {
  const auto compare = [&](const char *key, uint64_t found, const char *what) {
    uint64_t claimed = 0;
    fields.need(fields.whole(key, claimed), key);
    if (claimed == found) return;
    line.fail("%s=%llu, but the file has %llu %s lines: lines were lost or added", key,
              static_cast<unsigned long long>(claimed), static_cast<unsigned long long>(found),
              what);
  };
  compare("v", vertices, "v");
  compare("f", faces, "f");
  compare("l", lines, "l");
  compare("g", groups, "g");
  compare("mvs", records, "#mvs");
}

// Checks the line counts, which detect lost or added lines.
void ObjReader::end(Line &line) {
  const Valve &valve = out_.valve;
  Fields fields(line);
  counts_.check(fields, line);
  fields.end();
  if (!valve.triangle_fibre.empty() && valve.triangle_fibre.size() < valve.triangles.size()) {
    line.fail("only %zu of %zu triangles have a fibre: give one to each triangle, or omit all",
              valve.triangle_fibre.size(), valve.triangles.size());
  }
  const size_t cached = out_.state.cache.data.size();
  if (cached != cache_size_) {
    line.fail("the solver cache has %zu of its %llu numbers: lines were lost", cached,
              static_cast<unsigned long long>(cache_size_));
  }
  has_end_ = true;
}

}  // namespace mvs::core
