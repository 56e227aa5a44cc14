// The operations of the golden scenes, with parts and places of the parametric valve.
#include "tests/golden/operations.h"

#include <mvs/op.h>

#include <cstring>

namespace golden {
namespace {

mvs_site site_in(const Sim &sim, const char *scallop, double along, double down) {
  mvs_site site = {};
  site.how = MVS_SITE_ANATOMICAL;
  site.scallop = sim.id(MVS_PART_SCALLOP, scallop);
  site.u[0] = along;
  site.u[1] = down;
  return site;
}

template <typename Op>
Op op_of(uint32_t kind) {
  Op op;
  std::memset(&op, 0, sizeof op);
  op.op = {sizeof op, kind};
  return op;
}

template <typename Op, typename Fill>
OpCase op_case(const char *name, uint32_t kind, Fill fill) {
  return {name, [=](const Sim &sim) {
            auto op = op_of<Op>(kind);
            fill(sim, op);
            check(mvs_apply_op(sim, &op.op, nullptr));
          }};
}

}  // namespace

std::vector<OpCase> op_cases() {
  const auto chord = [](const Sim &sim, const char *name) { return sim.id(MVS_PART_CHORD, name); };
  const auto head = [](const Sim &sim, const char *name) { return sim.id(MVS_PART_HEAD, name); };
  return {
      op_case<mvs_op_chord_length>("chord_length", MVS_OP_CHORD_LENGTH,
                                   [=](const Sim &sim, auto &op) {
                                     op.chord = chord(sim, "A2/7");
                                     op.factor = 0.75;
                                   }),
      op_case<mvs_op_chord_remove>(
          "chord_remove", MVS_OP_CHORD_REMOVE,
          [=](const Sim &sim, auto &op) { op.chord = chord(sim, "P2/2"); }),
      op_case<mvs_op_chord_add>("chord_add", MVS_OP_CHORD_ADD,
                                [=](const Sim &sim, auto &op) {
                                  op.head = head(sim, "AL1");
                                  op.site = site_in(sim, "A2", 0.62, 0.85);
                                }),
      op_case<mvs_op_chord_transfer>("chord_transfer leaflet", MVS_OP_CHORD_TRANSFER,
                                     [=](const Sim &sim, auto &op) {
                                       op.chord = chord(sim, "P2/6");
                                       op.site = site_in(sim, "A2", 0.4, 0.8);
                                     }),
      op_case<mvs_op_chord_transfer>("chord_transfer head", MVS_OP_CHORD_TRANSFER,
                                     [=](const Sim &sim, auto &op) {
                                       op.chord = chord(sim, "A2/2");
                                       op.end = MVS_CHORD_END_HEAD;
                                       op.head = head(sim, "PM2");
                                     }),
      op_case<mvs_op_annulus_scale>("annulus_scale", MVS_OP_ANNULUS_SCALE,
                                    [](const Sim &, auto &op) {
                                      op.factor = 1.1;
                                      op.ap = 1.05;
                                    }),
      op_case<mvs_op_ring>("ring", MVS_OP_RING, [](const Sim &, auto &op) { op.size = 0.032; }),
      op_case<mvs_op_band>("band", MVS_OP_BAND, [](const Sim &, auto &op) { op.factor = 0.9; }),
      op_case<mvs_op_neochord>("neochord", MVS_OP_NEOCHORD,
                               [=](const Sim &sim, auto &op) {
                                 op.head = head(sim, "PM1");
                                 op.site = site_in(sim, "P2", 0.5, 1);
                                 op.length = 14e-3;
                               }),
      op_case<mvs_op_head_move>("head_move", MVS_OP_HEAD_MOVE,
                                [=](const Sim &sim, auto &op) {
                                  op.head = head(sim, "PM1");
                                  op.by[2] = -3e-3;
                                  op.frame = 1;
                                }),
      op_case<mvs_op_clip>("clip", MVS_OP_CLIP, [](const Sim &, auto &) {}),
      op_case<mvs_op_resect>("resect triangle", MVS_OP_RESECT, [](const Sim &, auto &) {}),
      op_case<mvs_op_resect>("resect quadrangle", MVS_OP_RESECT,
                             [](const Sim &, auto &op) {
                               op.width = 8e-3;
                               op.base_width = 5e-3;
                             }),
      op_case<mvs_op_patch>(
          "patch", MVS_OP_PATCH,
          [](const Sim &sim, auto &op) { op.site = site_in(sim, "A2", 0.5, 0.5); }),
  };
}

}  // namespace golden
