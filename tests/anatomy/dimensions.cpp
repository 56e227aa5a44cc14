// Rules for the dimensions of a parametric valve: a violation is refused with a sentence that names
// the dimension.
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "base/error.h"

using namespace mvs::core;

namespace {

constexpr double mm = 1e-3;

struct Field {
  const char *name;
  double mvs_parametric_desc::*member;
  double too_small, too_large;
  const char *says;  // part of the sentence for too_large
};

const Field fields[] = {
    {"annulus_ap", &mvs_parametric_desc::annulus_ap, 9 * mm, 61 * mm,
     "61 mm, it must be 10 to 60 mm"},
    {"annulus_cc", &mvs_parametric_desc::annulus_cc, 9 * mm, 71 * mm, "71 mm"},
    {"saddle_height", &mvs_parametric_desc::saddle_height, -1 * mm, 16 * mm, "16 mm"},
    {"anterior_height", &mvs_parametric_desc::anterior_height, 7 * mm, 46 * mm, "46 mm"},
    {"posterior_height", &mvs_parametric_desc::posterior_height, 4 * mm, 36 * mm, "36 mm"},
    {"commissure_height", &mvs_parametric_desc::commissure_height, 2 * mm, 21 * mm, "21 mm"},
    {"thickness", &mvs_parametric_desc::thickness, 0.05 * mm, 6 * mm, "6 mm"},
    {"papillary_depth", &mvs_parametric_desc::papillary_depth, 9 * mm, 61 * mm, "61 mm"},
    {"papillary_separation", &mvs_parametric_desc::papillary_separation, 3 * mm, 51 * mm, "51 mm"},
    {"annulus_contraction", &mvs_parametric_desc::annulus_contraction, 0.6, 1.4, "1.4"},
    {"annulus_scale", &mvs_parametric_desc::annulus_scale, 0.2, 2.1, "0.25 to 2"},
    {"chord_slack", &mvs_parametric_desc::chord_slack, 0.4, 2.1, "0.5 to 2"},
    {"indentation_depth", &mvs_parametric_desc::indentation_depth, -1 * mm, 9 * mm, "9 mm"},
    {"coaptation_depth", &mvs_parametric_desc::coaptation_depth, -1 * mm, 16 * mm, "16 mm"},
};

// Returns the error that generating this valve throws; the test fails if it throws no error.
Error error_of(const mvs_parametric_desc &desc) {
  try {
    make_parametric_valve(desc);
  } catch (const Error &error) {
    return error;
  }
  FAIL("no error");
  return Error(MVS_OK, "", "");
}

}  // namespace

TEST_CASE("a_dimension_out_of_range_is_named_with_its_value_and_range") {
  for (const Field &field : fields) {
    CAPTURE(field.name);
    for (double value : {field.too_small, field.too_large, double(NAN), double(INFINITY), -1.0}) {
      mvs_parametric_desc desc{};
      desc.*field.member = value;
      const Error error = error_of(desc);
      CHECK(error.code == MVS_E_ARGUMENT);
      CHECK(error.part == field.name);
      if (value == field.too_large) {
        CHECK(std::string(error.what()).find(field.says) != std::string::npos);
      }
    }
  }
}

TEST_CASE("counts_out_of_range_are_named") {
  for (uint32_t vertices : {1u, 199u, 100001u, UINT32_MAX}) {
    mvs_parametric_desc desc{};
    desc.vertices = vertices;
    CHECK(error_of(desc).part == "vertices");
  }
  for (uint32_t chords : {1u, 19u, 401u}) {
    mvs_parametric_desc desc{};
    desc.chords = chords;
    CHECK(error_of(desc).part == "chords");
  }
  mvs_parametric_desc desc{};
  desc.branching = 3;
  CHECK(error_of(desc).part == "branching");
  desc.branching = 0;
  desc.vertices = 200;
  desc.chords = 400;
  CHECK(error_of(desc).part == "chords");
}

TEST_CASE("an_unknown_shape_or_law_is_named") {
  mvs_parametric_desc desc{};
  desc.shape = 3;
  CHECK(error_of(desc).part == "shape");
  desc.shape = 0;
  desc.leaflet_law = 7;
  CHECK(error_of(desc).part == "leaflet_law");
}

TEST_CASE("dimensions_that_contradict_each_other_are_named") {
  mvs_parametric_desc desc{};
  desc.annulus_ap = 50 * mm;
  CHECK(error_of(desc).part == "annulus_ap");
  desc = {};
  desc.annulus_ap = 20 * mm;
  desc.annulus_cc = 51 * mm;
  CHECK(error_of(desc).part == "annulus_cc");
  desc = {};
  desc.commissure_height = 12 * mm;
  CHECK(error_of(desc).part == "commissure_height");
  desc = {};
  desc.indentation_depth = 7 * mm;
  CHECK(error_of(desc).part == "indentation_depth");
  desc = {};
  desc.papillary_depth = 10 * mm;
  desc.coaptation_depth = 6 * mm;
  CHECK(error_of(desc).part == "papillary_depth");
}
