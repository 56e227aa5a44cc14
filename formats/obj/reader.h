// Reader of extended OBJ: OBJ statements in read.cpp, #mvs lines in records.cpp and
// part_records.cpp. Every index, number and name is checked where it is read: the result may be an
// invalid valve (make_model checks that), but has no index out of range. Memory is not allocated by
// counts that the file claims.
#pragma once

#include <array>
#include <functional>
#include <map>

#include "formats/formats.h"
#include "formats/obj/words.h"
#include "formats/text/line.h"

namespace mvs::core {

// Lines read so far, by statement.
struct ObjCounts {
  uint64_t vertices = 0, faces = 0, lines = 0, groups = 0, records = 0;

  // Compares the counts with the keys of the `#mvs end` line.
  void check(Fields &fields, const Line &line) const;
};

// The present group: its words, and their indices from its first face on.
struct ObjGroup {
  std::string_view leaflet_word, scallop_word;
  uint32_t leaflet = none, scallop = none;
};

// A line, or an attribute of one, that may be given once.
inline void once(bool &given, const char *word, const Line &line) {
  if (given) line.fail("%s is given twice", word);
  given = true;
}

enum class ObjAttribute { rest, open, loaded, origin, velocity, thickness, chord };

// Attributes given so far for the last v, f and l line.
class GivenAttributes {
 public:
  bool has(ObjAttribute attribute) const { return given_[place(attribute)]; }
  // Fails if it is given already; `word` names it.
  void add(ObjAttribute attribute, const char *word, const Line &line) {
    once(given_[place(attribute)], word, line);
  }
  void drop(ObjAttribute attribute) { given_[place(attribute)] = false; }

 private:
  static size_t place(ObjAttribute attribute) { return static_cast<size_t>(attribute); }

  std::array<bool, 7> given_ = {};
};

class ObjReader {
 public:
  Loaded read(std::string_view text);

 private:
  void statement(std::string_view content, Line &line);
  static void comment(std::string_view text, const Line &line);
  void vertex(Line &line);
  void group(Line &line);
  void face(Line &line);
  void segments(Line &line);

  void record(Line &line);
  void version(std::string_view word, Line &line);
  void valve(Line &line);
  void state(Line &line);
  void solver_cache(Line &line);
  void solver_cache_data(Line &line);
  void leaflet(Line &line);
  void scallop(Line &line);
  const Vec3 &vector_of_vertex(ObjAttribute attribute, const char *what, CowVector<Vec3> &vectors,
                               Line &line);
  void rest(Line &line);
  void open(Line &line);
  void loaded(Line &line);
  void origin(Line &line);
  void velocity(Line &line);
  void annulus(Line &line);
  void head(Line &line);
  void ring(Line &line);
  void ring_point(Line &line);
  void curve(Line &line);
  void curve_point(Line &line);
  uint32_t curve_of(Fields &fields, const Line &line) const;
  void thickness(Line &line);
  void fibre(Line &line);
  void chord(Line &line);
  void end(Line &line);

  void enter_group(const Line &line);
  template <typename Item>
  static void check_room(const CowVector<Item> &items, const Line &line);
  void check_complete(const Line &last) const;

  Loaded out_;
  std::map<std::string, uint32_t, std::less<>> leaflets_, scallops_, curves_;
  ObjGroup group_;
  size_t segments_in_line_ = 0;
  GivenAttributes given_;
  ObjCounts counts_;
  bool has_version_ = false, has_valve_ = false, has_state_ = false, has_end_ = false;
  uint64_t cache_size_ = 0;  // numbers that the solver cache says it has; 0: no cache
};

template <typename Item>
void ObjReader::check_room(const CowVector<Item> &items, const Line &line) {
  constexpr size_t most = size_t{1} << 22;
  if (items.size() < most) return;
  line.fail("the limit is %zu vertices, triangles, segments or parts of one kind", most);
}

// x y z in mm.
inline Vec3 read_place(Line &line) {
  const double x = line.number(obj::mm), y = line.number(obj::mm), z = line.number(obj::mm);
  return {x, y, z};
}

}  // namespace mvs::core
