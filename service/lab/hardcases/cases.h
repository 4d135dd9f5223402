// The functions behind hardCases(), by the number of physics.md section 6.
#pragma once

#include "service/lab/hardcases/case_run.h"

namespace bleedsim::lab {

void coincidentParticles(CaseRun& run);  // 1
void fiveThousandInACell(CaseRun& run);  // 2
void overlappingSeeds(CaseRun& run);     // 3
void bullet(CaseRun& run);               // 4
void millionfoldForce(CaseRun& run);     // 5
void sweptSphere(CaseRun& run);          // 6
void viscosityStep(CaseRun& run);        // 7
void checkerboard(CaseRun& run);         // 8
void filmAndFilament(CaseRun& run);      // 9
void ballistics(CaseRun& run);           // 10
void timeStepRequests(CaseRun& run);     // 11
void deepColumn(CaseRun& run);           // 12
void cuspAndGaps(CaseRun& run);          // 13
void pressureSteps(CaseRun& run);        // 14
void leavingTheDomain(CaseRun& run);     // 15
void denormals(CaseRun& run);            // 16
void weightlessRest(CaseRun& run);       // 17
void badCommands(CaseRun& run);          // 18
void fullToCapacity(CaseRun& run);       // 19
void sameBits(CaseRun& run);             // 20

}  // namespace bleedsim::lab
