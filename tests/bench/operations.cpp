// Each operation as a function of the closed valve.
#include "tests/bench/operations.h"

#include <mvs/op.h>

#include "base/error.h"

using namespace mvs::core;

namespace bench {
namespace {

template <typename Op>
Op op_of(uint32_t kind) {
  Op op = {};
  op.op = {sizeof op, kind};
  return op;
}

template <typename Part>
Id id_of(const std::vector<Part> &parts, const std::string &name) {
  for (const Part &part : parts) {
    if (part.name == name) return part.id;
  }
  fail(MVS_E_ARGUMENT, "bench", "the valve has no %s", name.c_str());
}

mvs_site site_in(const Valve &v, const std::string &scallop, double along, double down) {
  mvs_site site = {};
  site.how = MVS_SITE_ANATOMICAL;
  site.scallop = id_of(v.scallops.get(), scallop);
  site.u[0] = along;
  site.u[1] = down;
  return site;
}

Operation chord_length(const std::string &name, double factor) {
  return {"chord_length", name + " " + std::to_string(factor).substr(0, 4),
          [=](const ModelState &p) {
            auto op = op_of<mvs_op_chord_length>(MVS_OP_CHORD_LENGTH);
            op.chord = id_of(p.model->valve.chords.get(), name);
            op.factor = factor;
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

Operation chord_remove(const std::string &name) {
  return {"chord_remove", name, [=](const ModelState &p) {
            auto op = op_of<mvs_op_chord_remove>(MVS_OP_CHORD_REMOVE);
            op.chord = id_of(p.model->valve.chords.get(), name);
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

// Transfers a chord to a place on a leaflet, from the first head or the second.
template <typename Op>
Operation tie(uint32_t kind, const char *name, const std::string &scallop, int head) {
  return {name, scallop, [=](const ModelState &p) {
            auto op = op_of<Op>(kind);
            op.head = p.model->valve.heads[head].id;
            op.site = site_in(p.model->valve, scallop, 0.5, 0.85);
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

Operation chord_transfer(const std::string &name, const std::string &scallop) {
  return {"chord_transfer", name + " to " + scallop, [=](const ModelState &p) {
            auto op = op_of<mvs_op_chord_transfer>(MVS_OP_CHORD_TRANSFER);
            op.chord = id_of(p.model->valve.chords.get(), name);
            op.site = site_in(p.model->valve, scallop, 0.5, 0.85);
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

Operation annulus_scale(const std::string &name, double factor, double ap) {
  return {"annulus_scale", name, [=](const ModelState &p) {
            auto op = op_of<mvs_op_annulus_scale>(MVS_OP_ANNULUS_SCALE);
            op.factor = factor;
            op.ap = ap;
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

Operation head_move(const std::string &name, int head, double z) {
  return {"head_move", name, [=](const ModelState &p) {
            auto op = op_of<mvs_op_head_move>(MVS_OP_HEAD_MOVE);
            op.head = p.model->valve.heads[head].id;
            op.by[2] = z;
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

// An operation with one value, all other fields at their defaults.
template <typename Op>
Operation with(uint32_t kind, const char *kind_name, const std::string &name, double Op::*field,
               double value) {
  return {kind_name, name, [=](const ModelState &p) {
            auto op = op_of<Op>(kind);
            op.*field = value;
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

Operation patch(const std::string &scallop) {
  return {"patch", scallop, [=](const ModelState &p) {
            auto op = op_of<mvs_op_patch>(MVS_OP_PATCH);
            op.site = site_in(p.model->valve, scallop, 0.5, 0.5);
            return perform(p, mvs::core::Operation(&op.op));
          }};
}

}  // namespace

std::vector<Operation> operations() {
  std::vector<Operation> all;
  for (const char *name : {"A2/7", "A2/2", "A1/7", "P2/2", "P2/6", "P1/3"}) {
    all.push_back(chord_length(name, 0.75));
    all.push_back(chord_remove(name));
  }
  all.push_back(chord_length("A2/7", 1.25));
  all.push_back(chord_length("P2/2", 0.90));
  for (const char *scallop : {"A2", "P2"}) {
    all.push_back(tie<mvs_op_chord_add>(MVS_OP_CHORD_ADD, "chord_add", scallop, 0));
    all.push_back(tie<mvs_op_neochord>(MVS_OP_NEOCHORD, "neochord", scallop, 1));
    all.push_back(patch(scallop));
  }
  all.push_back(chord_transfer("A2/2", "A1"));
  all.push_back(chord_transfer("P2/6", "A2"));
  all.push_back(annulus_scale("0.97", 0.97, 0));
  all.push_back(annulus_scale("0.90", 0.90, 0));
  all.push_back(annulus_scale("AP 0.85", 0, 0.85));
  all.push_back(head_move("2 mm up", 0, 2e-3));
  all.push_back(head_move("1 mm down", 1, -1e-3));
  all.push_back(with(MVS_OP_RING, "ring", "34", &mvs_op_ring::size, 34e-3));
  all.push_back(with(MVS_OP_RING, "ring", "30", &mvs_op_ring::size, 30e-3));
  all.push_back(with(MVS_OP_BAND, "band", "0.9", &mvs_op_band::factor, 0.9));
  all.push_back(with(MVS_OP_CLIP, "clip", "5 mm", &mvs_op_clip::width, 5e-3));
  all.push_back(with(MVS_OP_RESECT, "resect", "triangle", &mvs_op_resect::width, 8e-3));
  all.push_back(with(MVS_OP_RESECT, "resect", "quadrangle", &mvs_op_resect::base_width, 4e-3));
  return all;
}

}  // namespace bench
