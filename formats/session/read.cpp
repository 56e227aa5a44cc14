// Reader of sessions. Arrays, lists, models and entries are built once by their number in the file,
// so that shared data is shared again.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/bit_cast.h"
#include "base/error.h"
#include "formats/formats.h"
#include "formats/session/checks.h"
#include "formats/session/layout.h"
#include "formats/session/pool.h"

namespace mvs::core {
namespace {

template <typename Thing>
using Made = std::map<uint64_t, Thing>;

class SessionReader {
 public:
  explicit SessionReader(const H5Tree &tree)
      : words_(tree.at<uint64_t>("mvs/snapshot")),
        parts_(tree, "mvs/parts"),
        numbers_(tree, "mvs/numbers"),
        indices_(tree, "mvs/indices"),
        texts_(tree, "mvs/texts") {}

  Snapshot read() {
    Snapshot snapshot;
    pass(*this, snapshot);
    check_history(snapshot.history);
    must_be_used_up();
    return snapshot;
  }

  // the archive functions of layout.h
  void word(uint64_t &number) { number = next(); }
  void word(int64_t &number) { number = static_cast<int64_t>(next()); }
  void word(uint32_t &number);
  template <Enum Kind>
  void word(Kind &kind) {
    uint32_t number = 0;
    word(number);
    kind = static_cast<Kind>(number);
  }
  void choice(RecordedEvent::Kind &kind);
  void number(double &value);
  void text(std::string &text);
  template <typename Element>
  void array(CowVector<Element> &items);
  template <typename Part>
  void list(CowVector<Part> &parts);
  void model(ModelPtr &model);
  void shape(ToolShapePtr &shape);
  void points(mvs_array &given);
  void optional_text(const char *&given);
  template <typename Item>
  void list(PersistentList<Item> &items);
  static void check(const ModelState &current) { check_state(current); }
  static void check(const RecordedEvent &event) { check_event(event); }
  void optional(std::shared_ptr<const ModelState> &current);
  void optional(std::shared_ptr<const std::vector<Checkpoint>> &checkpoints);

 private:
  uint64_t next() {
    MVS_MUST(!words_.empty(), MVS_E_FORMAT, "mvs", "a part of the file ends too early");
    const uint64_t word = words_.front();
    words_ = words_.subspan(1);
    return word;
  }
  // Returns the number of following items, each of at least one word.
  uint64_t count() {
    const uint64_t number = next();
    MVS_MUST(number <= words_.size(), MVS_E_FORMAT, "mvs", "a part of the file ends too early");
    return number;
  }
  void must_be_used_up() const {
    MVS_MUST(words_.empty(), MVS_E_FORMAT, "mvs", "a part of the file has words left over");
  }

  // Returns the item with the next number: built by work(item) from the words of its part at the
  // first reference.
  template <typename Thing, typename Work>
  const Thing &part(Made<Thing> &made, Work work) {
    const uint64_t number = next();
    const auto place = made.find(number);
    if (place != made.end()) return place->second;
    const std::span<const uint64_t> around = std::exchange(words_, parts_.at(number));
    Thing thing{};
    work(thing);
    must_be_used_up();
    words_ = around;
    return made.emplace(number, std::move(thing)).first->second;
  }
  template <typename Thing>
  Made<Thing> &made() {
    return std::get<Made<Thing>>(made_);
  }
  template <typename Value>
  std::span<const Value> values(uint64_t number) const;

  void item(RecordedEvent &event) { pass(*this, event); }
  void item(std::shared_ptr<const HistoryEntry> &entry);
  Operation operation();

  std::span<const uint64_t> words_;  // unread words of the present part
  const PoolReader<uint64_t> parts_;
  const PoolReader<double> numbers_;
  const PoolReader<uint32_t> indices_;
  const PoolReader<uint8_t> texts_;
  std::tuple<Made<CowVector<Vec3>>, Made<CowVector<Tri>>, Made<CowVector<double>>,
             Made<CowVector<uint32_t>>, Made<CowVector<Leaflet>>, Made<CowVector<Scallop>>,
             Made<CowVector<Chord>>, Made<CowVector<Head>>, Made<CowVector<Ring>>,
             Made<CowVector<Tool>>, Made<CowVector<ChordCurve>>, Made<CowVector<CurvePoint>>,
             Made<ToolShapePtr>, Made<ModelPtr>, Made<RecordedEvents>, Made<HistoryEntries>,
             Made<std::shared_ptr<const HistoryEntry>>>
      made_;
  ModelPtr last_model_;
  // data of the pointers of the operation being read
  std::vector<CowVector<Vec3>> points_;
  std::vector<std::unique_ptr<std::string>> names_;
};

void SessionReader::word(uint32_t &number) {
  const uint64_t word = next();
  MVS_MUST(word <= UINT32_MAX, MVS_E_FORMAT, "mvs", "a number of the file is too large");
  number = static_cast<uint32_t>(word);
}

void SessionReader::choice(RecordedEvent::Kind &kind) {
  const uint64_t word = next();
  MVS_MUST(word >= RecordedEvent::load && word <= RecordedEvent::tool_trajectory, MVS_E_FORMAT,
           "mvs", "the history of the file has an event of kind %llu, which does not exist",
           static_cast<unsigned long long>(word));
  kind = static_cast<RecordedEvent::Kind>(word);
}

void SessionReader::number(double &value) {
  value = bit_cast<double>(next());
  MVS_MUST(std::isfinite(value), MVS_E_FORMAT, "mvs", "a number of the file is not finite");
}

void SessionReader::text(std::string &text) {
  const std::span<const uint8_t> bytes = texts_.at(next());
  text.assign(bytes.begin(), bytes.end());
  check_text(text);
}

template <>
std::span<const double> SessionReader::values(uint64_t number) const {
  const std::span<const double> found = numbers_.at(number);
  MVS_MUST(std::all_of(found.begin(), found.end(), [](double v) { return std::isfinite(v); }),
           MVS_E_FORMAT, "mvs", "a number of the file is not finite");
  return found;
}
template <>
std::span<const uint32_t> SessionReader::values(uint64_t number) const {
  return indices_.at(number);
}

template <typename Element>
void SessionReader::array(CowVector<Element> &items) {
  constexpr size_t columns = Stored<Element>::columns;
  const uint64_t number = next();
  const auto place = made<CowVector<Element>>().find(number);
  if (place != made<CowVector<Element>>().end()) {
    items = place->second;
    return;
  }
  const auto found = values<typename Stored<Element>::Value>(number);
  MVS_MUST(found.size() % columns == 0, MVS_E_FORMAT, "mvs",
           "an array of the file has %zu values, which is not a multiple of %zu", found.size(),
           columns);
  std::vector<Element> elements(found.size() / columns);
  for (size_t k = 0; k < found.size(); ++k) {
    if constexpr (columns == 1) {
      elements[k] = found[k];
    } else {
      elements[k / columns][k % columns] = found[k];
    }
  }
  items = made<CowVector<Element>>().emplace(number, std::move(elements)).first->second;
}

template <typename Part>
void SessionReader::list(CowVector<Part> &parts) {
  parts = part(made<CowVector<Part>>(), [&](CowVector<Part> &all) {
    std::vector<Part> read(count());
    for (Part &one : read) pass(*this, one);
    all = std::move(read);
  });
}

void SessionReader::model(ModelPtr &model) {
  model = part(made<ModelPtr>(), [&](ModelPtr &it) {
    Valve valve = last_model_ ? last_model_->valve : Valve{};
    pass(*this, valve);
    last_model_ = it = make_model(std::move(valve), last_model_.get());
  });
}

void SessionReader::shape(ToolShapePtr &shape) {
  shape = part(made<ToolShapePtr>(), [&](ToolShapePtr &it) {
    std::vector<ToolBody> bodies(count());
    for (ToolBody &body : bodies) pass(*this, body);
    if (bodies.empty()) return;
    MVS_MUST(are_valid(bodies), MVS_E_FORMAT, "state",
             "the file has a tool with bodies that cannot be");
    it = ToolShapePtr(std::make_shared<const ToolShape>(std::move(bodies)));
  });
}

template <typename Item>
void SessionReader::list(PersistentList<Item> &items) {
  items = part(made<PersistentList<Item>>(), [&](PersistentList<Item> &all) {
    for (uint64_t left = count(); left > 0; --left) {
      Item one{};
      item(one);
      all = all.pushed(std::move(one));
    }
  });
}

void SessionReader::item(std::shared_ptr<const HistoryEntry> &entry) {
  entry = part(
      made<std::shared_ptr<const HistoryEntry>>(), [&](std::shared_ptr<const HistoryEntry> &it) {
        auto read =
            std::make_shared<HistoryEntry>(HistoryEntry{operation(), {}, 0, 0, {}, 0, {}, {}, {}});
        pass_rest(*this, *read);
        it = std::move(read);
      });
}

void SessionReader::optional(std::shared_ptr<const ModelState> &current) {
  if (count() == 0) return;
  auto read = std::make_shared<ModelState>();
  pass(*this, *read);
  current = std::move(read);
}

void SessionReader::optional(std::shared_ptr<const std::vector<Checkpoint>> &checkpoints) {
  std::vector<Checkpoint> read(count());
  for (Checkpoint &checkpoint : read) pass(*this, checkpoint);
  if (read.empty()) return;
  checkpoints = std::make_shared<const std::vector<Checkpoint>>(std::move(read));
}

Operation SessionReader::operation() {
  std::string name;
  text(name);
  const OpKind *const kind = find_op_kind(name);
  MVS_MUST(kind, MVS_E_VERSION, "mvs",
           "the history of the file has the operation %.63s, which this libmvs does not know",
           name.c_str());
  std::vector<uint64_t> bytes((kind->size + 7) / 8);
  char *const start = reinterpret_cast<char *>(bytes.data());
  *reinterpret_cast<mvs_op *>(start) = {kind->size, kind->number};
  points_.clear();
  names_.clear();
  for (uint64_t left = count(); left > 0; --left) {
    text(name);
    const uint64_t type = next();
    const auto found = std::find_if(kind->fields.begin(), kind->fields.end(),
                                    [&](const OpField &f) { return name == f.name; });
    MVS_MUST(found != kind->fields.end() && found->type == type, MVS_E_VERSION, "mvs",
             "the history of the file has a field %.63s of %s that this libmvs does not know",
             name.c_str(), kind->name);
    pass_field(*this, *found, start + found->offset);
  }
  try {
    return Operation(reinterpret_cast<const mvs_op *>(start));
  } catch (const Error &error) {
    fail(MVS_E_FORMAT, error.part, "the history of the file has an operation that cannot be: %s",
         error.what());
  }
}

void SessionReader::points(mvs_array &given) {
  const CowVector<Vec3> &points = points_.emplace_back();
  array(points_.back());
  if (!points.empty()) given = {points.data(), points.size(), 3, MVS_TYPE_F64, 0};
}

void SessionReader::optional_text(const char *&given) {
  const bool is_given = next() != 0;
  text(*names_.emplace_back(std::make_unique<std::string>()));
  if (is_given) given = names_.back()->c_str();
}

}  // namespace

Snapshot read_session(std::string_view bytes) {
  const H5Tree tree = read_h5(bytes, "mvs", session_version);
  check_arrays(tree);
  return SessionReader(tree).read();
}

}  // namespace mvs::core
