// The functions of the cases, for the catalog. What each measures is in its file.
#pragma once

#include "service/lab/validation/case.h"

namespace bleedsim::lab {

Result<CaseResult> runInterpolation(const Knobs& knobs);
Result<CaseResult> runFreeFall(const Knobs& knobs);
Result<CaseResult> runSpinningBlob(const Knobs& knobs);
Result<CaseResult> runInviscidBox(const Knobs& knobs);
Result<CaseResult> runHydrostatic(const Knobs& knobs);
Result<CaseResult> runPoiseuille(const Knobs& knobs);
Result<CaseResult> runCouette(const Knobs& knobs);
Result<CaseResult> runLayers(const Knobs& knobs);
Result<CaseResult> runCasson(const Knobs& knobs);
Result<CaseResult> runCarreau(const Knobs& knobs);
Result<CaseResult> runTaylorGreen(const Knobs& knobs);
Result<CaseResult> runDropPeriod(const Knobs& knobs);
Result<CaseResult> runDropPressure(const Knobs& knobs);
Result<CaseResult> runDamBreak(const Knobs& knobs);
Result<CaseResult> runOrificeLaw(const Knobs& knobs);
Result<CaseResult> runOrificeResolved(const Knobs& knobs);
Result<CaseResult> runPlateletSpread(const Knobs& knobs);
Result<CaseResult> runPlateletActivation(const Knobs& knobs);
Result<CaseResult> runIncline(const Knobs& knobs);
Result<CaseResult> runStandingWave(const Knobs& knobs);
Result<CaseResult> runPuddle(const Knobs& knobs);
Result<CaseResult> runSquarePatch(const Knobs& knobs);
Result<CaseResult> runContactAngle(const Knobs& knobs);
Result<CaseResult> runThickBlood(const Knobs& knobs);

}  // namespace bleedsim::lab
