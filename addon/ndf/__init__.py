"""Materials from a picture of their microfacets' normals: how it is set, drawn, made of a map, and read."""
