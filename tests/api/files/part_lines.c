/* A fault that the checks of a valve find after an OBJ file is read is reported with its line. */
#include "tests/api/check.h"

static mvs_sim *sim;

/* Two leaflets on a square annulus, one head with five chord segments, one of them two in a line.
 */
static const char *const good =
    "#mvs 1 units=mm\n"
    "#mvs valve name=small\n"
    "#mvs leaflet name=A thickness=1\n"
    "#mvs leaflet name=P\n"
    "v 15 0 0\nv 0 15 0\nv -15 0 0\nv 0 -15 0\n"
    "v 8 0 -10\nv 0 8 -10\nv -8 0 -10\nv 0 -8 -10\n"
    "v 0 0 -25\nv 1 -7 -18\n"
    "#mvs annulus 1 2 3 4\n"
    "#mvs head node=9 name=PM1\n"
    "#mvs curve name=tough\n#mvs curve_point 0 0\n#mvs curve_point 0.1 100000\n"
    "g A\nf 1 2 5\nf 2 6 5\nf 2 3 6\nf 3 7 6\n"
    "g P\nf 3 4 7\nf 4 8 7\nf 4 1 8\nf 1 5 8\n"
    "l 9 5\n#mvs chord name=A1/1 rest_length=16.5\n"
    "l 9 6\nl 9 7\n#mvs chord young=40000000\nl 9 10 8\n"
    "#mvs end v=10 f=8 l=4 g=2 mvs=12\n";

static int32_t line_of(const char *text, const char *at) {
  int32_t line = 1;
  for (; text < at; ++text) line += *text == '\n';
  return line;
}

/* Replaces the first `old`, and expects a fault of `part` in the line that begins with `where`. */
static void check_at(const char *where, const char *old, const char *instead, const char *part,
                     const char *sentence) {
  char text[2048];
  const char *at = strstr(good, old);
  CHECK(at != NULL);
  if (!at) return;
  const int size =
      snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, instead, at + strlen(old));
  MUST_FAIL(mvs_load_memory(sim, text, (uint64_t)size, MVS_FORMAT_OBJ), MVS_E_OP, sentence);
  const int32_t line = line_of(good, strstr(good, where));
  if (mvs_last_error()->line == line && strcmp(mvs_last_error()->part, part) == 0) return;
  ++failures;
  printf("%s: line %d, not %d, part %s: %s\n", instead, (int)mvs_last_error()->line, (int)line,
         mvs_last_error()->part, mvs_last_error()->message);
}

static void check(const char *old, const char *instead, const char *part, const char *sentence) {
  check_at(old, old, instead, part, sentence);
}

static void counted_parts_are_found(void) {
  check("v 8 0 -10", "v 8 0 9000", "node 4", "node 4 lies");
  check("v 8 0 -10", "v 8 0 9000", "node 4", "remove or correct it (these numbers count from 0)");
  check("f 3 7 6", "f 3 7 7", "triangle 3", "names a node twice");
  check_at("f 3 4 7", "f 2 6 5", "f 2 6 1", "edge 3-6", "like a Moebius strip");
  check("l 9 7\n#mvs chord young=40000000", "l 9 7\n#mvs chord kind=suture", "chord 2",
        "is a suture");
  check("l 9 10 8", "l 9 10 10", "chord 4", "leads from node 9 to itself");
  check("l 9 10 8", "l 9 9 8", "chord 3", "leads from node 8 to itself");
}

static void named_parts_are_found(void) {
  check("#mvs chord name=A1/1 rest_length=16.5", "#mvs chord name=A1/1 rest_length=16500",
        "chord A1/1", "rest length 16.5 m, outside");
  check("#mvs leaflet name=A thickness=1", "#mvs leaflet name=A low=1e30", "leaflet A", "outside");
  check("#mvs curve name=tough\n#mvs curve_point 0 0\n#mvs curve_point 0.1 ",
        "#mvs curve name=tough\n#mvs curve_point 0 0\n#mvs curve_point -0.1 ", "curve tough",
        "does not rise");
  check("#mvs head node=9", "#mvs head node=8", "papillary head 0", "of the sheet");
  check("#mvs valve name=small", "#mvs valve density=1", "valve", "density 1 kg/m3");
  check("#mvs annulus 1 2 3 4", "#mvs annulus 1 2", "annulus", "at least 3");
  check("#mvs annulus 1 2 3 4", "#mvs annulus 1 3 2 4", "annulus 0-2", "no edge joins them");
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_load_memory(sim, good, strlen(good), MVS_FORMAT_OBJ));
  counted_parts_are_found();
  named_parts_are_found();
  mvs_destroy(sim);
  return finish("part_lines");
}
