# Wounds: patch shapes, throats and their set.
list(APPEND sph_sources wound/buried_patch.cpp wound/orifice.cpp wound/patch_check.cpp wound/patch_geometry.cpp
     wound/patch_sites.cpp wound/throat.cpp wound/wound_rules.cpp wound/wound_set.cpp wound/wound_state.cpp)
