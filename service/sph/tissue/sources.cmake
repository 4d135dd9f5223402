list(APPEND sph_sources tissue/share_table.cpp tissue/signed_distance.cpp tissue/tissue_field.cpp)
