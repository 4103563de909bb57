// The channel of DFG 2D-1 with its cylinder; `./fpi mesh cylinder` makes cylinder.msh.
DefineConstant[ size = 1 ];  // factor of all sizes
SetFactory("OpenCASCADE");
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Rectangle(1) = {0, 0, 0, 2.2, 0.41};
Disk(2) = {0.2, 0.2, 0, 0.05};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
circle() = Curve In BoundingBox {0.14, 0.14, -1, 0.26, 0.26, 1};

// Size: fine on the circle, growing with the distance from it.
Field[1] = MathEval;
Field[1].F = Sprintf("%g * min(0.006 + 0.13*(sqrt((x-0.2)^2 + (y-0.2)^2) - 0.05), 0.07)", size);
Background Field = 1;
Transfinite Curve {circle()} = 1 + 4*Round(Pi*0.1 / (4*0.006*size));  // vertices in front, behind, above, below

Physical Surface("fluid") = {3};
Physical Curve("cylinder") = {circle()};
Physical Curve("inlet") = Curve In BoundingBox {-0.01, -0.01, -1, 0.01, 0.42, 1};
Physical Curve("outlet") = Curve In BoundingBox {2.19, -0.01, -1, 2.21, 0.42, 1};
Physical Curve("walls") = {Curve In BoundingBox {-0.01, -0.01, -1, 2.21, 0.01, 1},
                           Curve In BoundingBox {-0.01, 0.40, -1, 2.21, 0.42, 1}};
