// One operation as a JSON object: fields by name and unit, parts by name.
#include <cstring>

#include "base/error.h"
#include "formats/plan/named.h"
#include "formats/plan/plan.h"
#include "model/part_names.h"

namespace mvs::core {
namespace {

// "length_m"
std::string key_of(const OpField &f) {
  return *f.unit ? format("%s_%s", f.name, f.unit) : std::string(f.name);
}

// Returns the word of a choice, from "leaflet=1 head=2".
std::string word_of(const OpField &f, uint32_t value) {
  std::string_view rest = f.choices;
  const std::string ending = format("=%u", value);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find(' '));
    if (pair.ends_with(ending)) return std::string(pair.substr(0, pair.find('=')));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
  }
  return std::to_string(value);
}

// Calls use(parts, word) with the list of parts that a field names.
template <typename Use>
auto with_parts(const Valve &valve, const OpField &f, Use use) {
  if (f.type == MVS_FIELD_CHORD) return use(valve.chords, "chord");
  if (f.type == MVS_FIELD_HEAD) return use(valve.heads, "papillary head");
  return use(valve.scallops, "scallop");
}

template <typename Parts>
Id id_in(const Parts &parts, const std::string &name, const char *word) {
  if (const auto *part = find_named(parts, name)) return part->id;
  fail(MVS_E_ID, name, "the valve has no %s named \"%.63s\"%s", word, name.c_str(),
       near_names(name, parts).c_str());
}

Json point_json(const double *at) {
  return Json::numbers({at[0], at[1], at[2]});
}

Json site_json(const Model &model, const mvs_site &site) {
  Json json;
  if (site.how == MVS_SITE_NODE) json.set("node", site.index);
  if (site.how == MVS_SITE_TRIANGLE) {
    json.set("triangle", site.index);
    json.set("weights", point_json(site.u));
  }
  set_anatomical(model, site, json);
  return json;
}

Json points_json(const mvs_array &array) {
  Json json = Json::array();
  for (const Vec3 &p : points_of(array)) json.add(point_json(p.data()));
  return json;
}

// Returns null for a field that is not given.
Json field_json(const Operation &op, const OpField &f, const Model &model) {
  switch (f.type) {
    case MVS_FIELD_NUMBER: {
      const double value = op.field<double>(f);
      return value != 0 ? Json(value) : Json();
    }
    case MVS_FIELD_COUNT: {
      const uint32_t value = op.field<uint32_t>(f);
      return value != 0 ? Json(value) : Json();
    }
    case MVS_FIELD_CHOICE: {
      const uint32_t value = op.field<uint32_t>(f);
      return value != 0 ? Json(word_of(f, value)) : Json();
    }
    case MVS_FIELD_SITE: {
      const auto &site = op.field<mvs_site>(f);
      return site.how != MVS_SITE_NONE ? site_json(model, site) : Json();
    }
    case MVS_FIELD_POINT: {
      const auto &point = op.field<mvs_point>(f);
      return point.given ? point_json(point.at) : Json();
    }
    case MVS_FIELD_VECTOR:
      return point_json(op.field<double[3]>(f));
    case MVS_FIELD_POINTS: {
      const auto &array = op.field<mvs_array>(f);
      return array.count > 0 ? points_json(array) : Json();
    }
    case MVS_FIELD_TEXT: {
      const char *text = op.field<const char *>(f);
      return text ? Json(text) : Json();
    }
    default: {
      const Id id = op.field<Id>(f);
      if (id == 0) return Json();
      return with_parts(model.valve, f,
                        [&](const auto &parts, const char *) { return name_in(parts, id); });
    }
  }
}

// Builds the struct of an operation and owns the data of its pointers. Without a model, parts have
// no id: the keys, types and choices are checked all the same.
class OpReader {
 public:
  OpReader(const OpKind &kind, const Model *model, bool exact)
      : kind_(kind), model_(model), exact_(exact), words_((kind.size + 7) / 8, 0) {
    put(mvs_op{kind.size, kind.number}, 0);
  }

  // Reads the fields of a step.
  void read(const Json &step);
  Operation made() const { return Operation(reinterpret_cast<const mvs_op *>(words_.data())); }

 private:
  template <typename Value>
  void put(const Value &value, uint32_t offset) {
    std::memcpy(reinterpret_cast<char *>(words_.data()) + offset, &value, sizeof value);
  }
  [[noreturn]] void refuse(const OpField &f, const char *wanted) const {
    fail(MVS_E_FORMAT, format("%s.%s", kind_.name, f.name), "%s has to be %s", key_of(f).c_str(),
         wanted);
  }
  double number(const OpField &f, const Json &json) const {
    if (!json.is_number()) refuse(f, "a number");
    return json.number();
  }
  std::string text(const OpField &f, const Json &json) const {
    if (!json.is_text()) refuse(f, "a text");
    return json.text();
  }
  uint32_t whole(const OpField &f, const Json &json) const {
    if (!json.is_whole() || json.whole() > UINT32_MAX) refuse(f, "a whole number");
    return static_cast<uint32_t>(json.whole());
  }
  Vec3 point(const OpField &f, const Json &json) const {
    if (!json.is_array() || json.items().size() != 3) refuse(f, "three numbers, [x, y, z]");
    const std::vector<Json> &xyz = json.items();
    return {number(f, xyz[0]), number(f, xyz[1]), number(f, xyz[2])};
  }
  void read(const OpField &f, const Json &json);
  uint32_t choice(const OpField &f, const Json &json) const;
  Id part(const OpField &f, const std::string &name) const;
  mvs_site site(const OpField &f, const Json &json) const;
  mvs_array points(const OpField &f, const Json &json);

  const OpKind &kind_;
  const Model *model_;
  bool exact_;
  std::vector<uint64_t> words_;
  std::vector<std::unique_ptr<std::vector<Vec3>>> points_;
  std::vector<std::unique_ptr<std::string>> texts_;
};

uint32_t OpReader::choice(const OpField &f, const Json &json) const {
  const std::optional<uint32_t> value = choice_of(f, text(f, json));
  if (!value) refuse(f, f.choices);
  return *value;
}

Id OpReader::part(const OpField &f, const std::string &name) const {
  if (!model_) return 0;
  return with_parts(model_->valve, f,
                    [&](const auto &parts, const char *word) { return id_in(parts, name, word); });
}

bool is_site_key(std::string_view key) {
  static constexpr std::string_view known[] = {"scallop", "along",    "height",
                                               "node",    "triangle", "weights"};
  return std::find(std::begin(known), std::end(known), key) != std::end(known);
}

mvs_site OpReader::site(const OpField &f, const Json &json) const {
  if (!json.is_object()) refuse(f, "an object with scallop, along and height");
  for (const Json::Member &member : json.members()) {
    MVS_MUST(is_site_key(member.first), MVS_E_FORMAT, format("%s.%s", kind_.name, f.name),
             "%s has no field \"%.60s\"", key_of(f).c_str(), member.first.c_str());
  }
  mvs_site site = {};
  if (exact_ && json.has("node")) {
    site.how = MVS_SITE_NODE;
    site.index = whole(f, json["node"]);
  } else if (exact_ && json.has("triangle") && json.has("weights")) {
    site.how = MVS_SITE_TRIANGLE;
    site.index = whole(f, json["triangle"]);
    const Vec3 u = point(f, json["weights"]);
    std::copy(u.data(), u.data() + 3, site.u);
  } else {
    if (!json.has("scallop") || !json.has("along") || !json.has("height")) {
      refuse(f, "an object with scallop, along and height");
    }
    site.how = MVS_SITE_ANATOMICAL;
    site.scallop = part(f, text(f, json["scallop"]));
    site.u[0] = number(f, json["along"]);
    site.u[1] = number(f, json["height"]);
  }
  return site;
}

mvs_array OpReader::points(const OpField &f, const Json &json) {
  if (!json.is_array()) refuse(f, "a list of points, [[x, y, z], ...]");
  auto list = std::make_unique<std::vector<Vec3>>();
  for (const Json &one : json.items()) list->push_back(point(f, one));
  points_.push_back(std::move(list));
  return {points_.back()->data(), points_.back()->size(), 3, MVS_TYPE_F64, 0};
}

void OpReader::read(const OpField &f, const Json &json) {
  switch (f.type) {
    case MVS_FIELD_NUMBER:
      return put(number(f, json), f.offset);
    case MVS_FIELD_COUNT:
      return put(whole(f, json), f.offset);
    case MVS_FIELD_CHOICE:
      return put(choice(f, json), f.offset);
    case MVS_FIELD_SITE:
      return put(site(f, json), f.offset);
    case MVS_FIELD_POINT: {
      const Vec3 p = point(f, json);
      return put(mvs_point{{p[0], p[1], p[2]}, 1, 0}, f.offset);
    }
    case MVS_FIELD_VECTOR: {
      const Vec3 p = point(f, json);
      return put(std::array<double, 3>{p[0], p[1], p[2]}, f.offset);
    }
    case MVS_FIELD_POINTS:
      return put(points(f, json), f.offset);
    case MVS_FIELD_TEXT:
      texts_.push_back(std::make_unique<std::string>(text(f, json)));
      return put(texts_.back()->c_str(), f.offset);
    default:
      return put(part(f, text(f, json)), f.offset);
  }
}

// Returns whether a key is a remark: allowed in a step besides the fields of its operation.
bool is_remark(std::string_view key) {
  static constexpr std::string_view remarks[] = {"do",       "title",  "made",  "time", "group",
                                                 "group_id", "before", "after", "notes"};
  return std::find(std::begin(remarks), std::end(remarks), key) != std::end(remarks);
}

const OpKind &kind_of(const Json &json) {
  const OpKind *kind = find_op_kind(json["do"].text());
  MVS_MUST(kind != nullptr, MVS_E_VERSION, "plan",
           "the operation \"%.40s\" is not known to this version of libmvs",
           json["do"].text().c_str());
  return *kind;
}

void OpReader::read(const Json &step) {
  for (const Json::Member &member : step.members()) {
    const std::string &key = member.first;
    if (is_remark(key)) continue;
    const auto f = std::find_if(kind_.fields.begin(), kind_.fields.end(),
                                [&](const OpField &field) { return key_of(field) == key; });
    MVS_MUST(f != kind_.fields.end(), MVS_E_FORMAT, kind_.name, "%s has no field \"%.60s\"",
             kind_.name, key.c_str());
    read(*f, member.second);
  }
}

}  // namespace

Json op_json(const Operation &op, const Model &model) {
  Json json;
  json.set("do", op.kind().name);
  for (const OpField &f : op.kind().fields) {
    Json value = field_json(op, f, model);
    if (!value.is_null()) json.set(key_of(f), std::move(value));
  }
  return json;
}

Operation read_op(const Json &json, const Model &model, bool exact) {
  OpReader reader(kind_of(json), &model, exact);
  reader.read(json);
  return reader.made();
}

void check_op(const Json &json) {
  OpReader(kind_of(json), nullptr, true).read(json);
}

}  // namespace mvs::core
