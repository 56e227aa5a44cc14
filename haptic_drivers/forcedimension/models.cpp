// Table of nominal limits (CHAI3D, CDeltaDevices.cpp).
#include "models.h"

#include "dhd.h"

namespace forcedimension {

Model model_of(int type) {
  switch (type) {
    case kDelta3:
      return {20, 0, 5000, 30, 0.15};
    case kOmega3:
    case kOmega6Right:
    case kOmega6Left:
    case kOmega7Right:
    case kOmega7Left:
      return {12, 0, 5000, 30, 0.075};
    case kSigma3:
      return {12, 0, 4000, 30, 0.075};
    case kSigma7Right:
    case kSigma7Left:
      return {12, 0.2, 4000, 30, 0.075};
    case kLambda3:
      return {12, 0, 4000, 30, 0.11};
    case kLambda7Right:
    case kLambda7Left:
      return {12, 0.2, 4000, 30, 0.11};
    case kFalcon:
    default:
      return {8, 0, 3000, 20, 0.04};
  }
}

}  // namespace forcedimension
