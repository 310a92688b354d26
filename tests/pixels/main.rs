//! Pictures, made as users make them: by the whole pipeline on a device, and by the binary.

mod bad_input;
mod base;
mod borders;
mod command;
mod compare;
mod comparison;
mod documented;
mod embedded;
mod golden;
mod lights;
mod modelling;
mod opengl;
mod overwriting;
mod poses;
mod radiance;
mod reference;
mod reference_command;
mod run;
mod screenshot;
mod sheen_models;
mod shown;
mod stage;
mod state;
mod tables;
mod textures;
mod truth;
