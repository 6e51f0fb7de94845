//! Command lines and INI files of programs that call `povray`, as they write them.

use super::*;

const SCENE: &str = "\
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
light_source { <4, 8, -6>, rgb 1 }
sphere { clock*x, 1 pigment { color rgb <1, 0, 0> } }
";

/// Runs words of a command line as a shell splits them, with `bin` as the folder of programs.
fn shell(place: &Place, line: &str) -> Run {
    let bin = place.path("bin");
    if !bin.exists() {
        fs::create_dir(&bin).expect("a folder");
        std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_lucarne"), bin.join("povray"))
            .expect("a link");
    }
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").expect("a path"));
    let mut run = Command::new("sh");
    run.args(["-c", line]).current_dir(place.0.path()).env("PATH", path).stdin(Stdio::null());
    Run(run.output().expect("it runs"))
}

#[test]
fn command_lines_of_other_programs_render() {
    // Each with the pictures that it makes.
    for (line, pictures) in [
        // ASE: an INI file beside the scene.
        ("povray ase.ini", &["ase.png"][..]),
        // vapory.
        ("povray +I__temp__.pov +W16 +H12 Output_File_Type=N +Ovapory.png", &["vapory.png"]),
        ("povray +I__temp__.pov +W16 +H12 +FN +O- > pipe.png", &["pipe.png"]),
        (
            "povray +I__temp__.pov Quality=9 Antialias=on Antialias_Threshold=0.01 +FN +Oalpha.png Output_Alpha=on +H12 +W16",
            &["alpha.png"],
        ),
        // VTK, ParaView.
        ("povray +W16 +H12 +Ia.pov +Ovtk.png +A +UA", &["vtk.png"]),
        // PyMOL.
        ("povray +I'a.pov' +O'pymol.png' +W16 +H12 +A0.0 -D +UA", &["pymol.png"]),
        // Open Babel's manual.
        (
            "povray a.pov +W16 +H12 +P -D0 +FN +Oobabel.png Library_Path=. Verbose=false",
            &["obabel.png"],
        ),
        // KPovModeler.
        (
            "povray Input_File_Name='a.pov' Output_File_Name='kpm.png' Width=16 Height=12 Output_to_File=on Output_File_Type=N Quality=9 Antialias=off Sampling_Method=1 Antialias_Threshold=0.3 Antialias_Depth=3 Jitter=off Jitter_Amount=1.0 Display=off Pause_When_Done=off Verbose=on Radiosity_File_Name=''",
            &["kpm.png"],
        ),
        ("povray +Ikpm.ini", &[]),
        // Blender's povanim, and its POV add-on.
        ("povray /EXIT a.pov", &[]),
        ("povray blender.ini", &["frame0001.png"]),
        (
            "povray a.pov +W16 +H12 +FN +Oanim +KFI1 +KFF3 +KI0.0 +KF1.0 -D",
            &["anim1.png", "anim2.png", "anim3.png"],
        ),
        (
            "for i in 1 2; do povray +Ia.pov +Oloop$i.png +W16 +H12 +K0.$i -D -V -GA || exit 1; done",
            &["loop1.png", "loop2.png"],
        ),
        // Shell scripts and makefiles.
        ("povray +a0.1 +am2 +r3 +j +fn8 +w16 +h12 +q11 +ua -d -p -v +i a.pov", &[]),
        ("povray -w16 -h12 -q9 -a0.3 -d -p -x -oscript.png a.pov", &["script.png"]),
        ("povray +W16 +H12 +Ia.pov +Otype.tga +FT +A0.1 -D +WT2 +BM2 +BS16 +RP1", &["type.tga"]),
        ("nice povray '+W16 +H12 -D +A +R2' +Ia.pov +Onice.jpg +FJ Compression=90", &["nice.jpg"]),
        (
            "povray +Ia +Oppm.ppm +FP16 +W16 +H12 +L/usr/share/povray-3.7/include +L. -GS -GR +GFfatal.log -C -F +F",
            &["ppm.ppm"],
        ),
        ("povray quick.ini a.pov +MV3.7 +SP64 +EP8 +SR0.25 +ER0.75 +Oquick.png", &["quick.png"]),
        ("povray 'film.ini[low]' Post_Scene_Command=true +Ofilm_", &["film_1.png", "film_2.png"]),
        ("cat a.pov | povray +I- +W16 +H12 +Ostdin.png", &["stdin.png"]),
        (
            "povray +Ia.pov +Oheight.png +FN Grayscale_Output=on File_Gamma=1.0 +W16 +H12",
            &["height.png"],
        ),
        // jobs of render farms: bands.
        (
            "povray +Ia.pov +Oband +FN +W16 +H12 +SR7 +ER12 Bits_Per_Color=16 Max_Image_Buffer_Memory=512 Test_Abort_Count=100",
            &["band.png"],
        ),
    ] {
        let place = Place::new();
        place.write("a.pov", SCENE);
        place.write("__temp__.pov", SCENE);
        place.write("ase.ini", "Input_File_Name=a.pov\nOutput_to_File=True\nOutput_File_Type=N\nOutput_Alpha=on\n; if you adjust Height, and width, you must preserve the ratio\nWidth=16\nHeight=12.0\nAntialias=True\nAntialias_Threshold=0.1\nDisplay=False\nDisplay_Gamma=2.2\nPause_When_Done=False\nVerbose=False\nOutput_File_Name=ase.png\n");
        place.write("blender.ini", "Version=3.7\nInput_File_Name='a.pov'\nOutput_File_Name='frame0001.png'\nWidth=16\nHeight=12\nBounding_Method=2\nDisplay=0\nPause_When_Done=0\nOutput_File_Type=N\nOutput_Alpha=0\nSampling_Method=2\nAntialias_Depth=3\nAntialias_Threshold=0.1\nAntialias_Gamma=2.5\nJitter=off\nAntialias=On\n");
        place.write("film.ini", "[low]\nWidth=16\nHeight=12\nInput_File_Name=a.pov\nInitial_Frame=1\nFinal_Frame=2\nCyclic_Animation=on\n[high]\nWidth=1600\n");
        place.write("quick.ini", "+W16 +H12\n-D +Q3 ; quick\n");
        let run = shell(&place, line);
        match pictures {
            // A line that POV-Ray refuses, too.
            [] => assert_eq!(run.code(), 1, "{line}: {}", run.stderr()),
            pictures => {
                assert_eq!(run.code(), 0, "{line}: {}", run.stderr());
                for name in pictures {
                    let size = image::image_dimensions(place.path(name));
                    assert_eq!(size.expect(name), (16, 12), "{line}");
                }
            }
        }
    }
}
