// The channel of DFG 2D-2 with its cylinder and its wake; `./fpi mesh cylinder_shedding` makes cylinder_shedding.msh.
DefineConstant[ size = 1 ];  // factor of all sizes
SetFactory("OpenCASCADE");
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Rectangle(1) = {0, 0, 0, 2.2, 0.41};
Disk(2) = {0.2, 0.2, 0, 0.05};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
circle() = Curve In BoundingBox {0.14, 0.14, -1, 0.26, 0.26, 1};

// Size: finest on the circle, coarser in front of it than behind; fine in the first diameters of the wake.
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (0.0045 + 0.09*(sqrt((x-0.2)^2 + (y-0.2)^2) - 0.05) + 0.15*max(0, 0.15-x))", size);
Field[2] = MathEval;
Field[2].F = Sprintf("%g * min(0.06, 0.0135 + 0.12*max(0, x-0.35) + 0.25*max(0, max(0.2-x, abs(y-0.2)-0.08)))", size);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Transfinite Curve {circle()} = 1 + 4*Round(Pi*0.1 / (4*0.0045*size));  // vertices in front, behind, above, below

Physical Surface("fluid") = {3};
Physical Curve("cylinder") = {circle()};
Physical Curve("inlet") = Curve In BoundingBox {-0.01, -0.01, -1, 0.01, 0.42, 1};
Physical Curve("outlet") = Curve In BoundingBox {2.19, -0.01, -1, 2.21, 0.42, 1};
Physical Curve("walls") = {Curve In BoundingBox {-0.01, -0.01, -1, 2.21, 0.01, 1},
                           Curve In BoundingBox {-0.01, 0.40, -1, 2.21, 0.42, 1}};
