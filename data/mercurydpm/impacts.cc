// Impacts of equal solid spheres in MercuryDPM: measure.py fills in the words in capitals.
#include <fstream>
#include "Mercury3D.h"
#include "Species/LinearViscoelasticSlidingFrictionSpecies.h"
#include "Walls/InfiniteWall.h"

// Spheres that meet equal ones, or a flat wall, without spin; all in one simulation, SI units.
struct Impacts : Mercury3D
{
    double radius, friction, speed, begins;
    bool atWall;
    std::vector<double> incidence;
    std::vector<SphericalParticle*> spheres;

    // The lines that planarimpact prints, as they are.
    void lines(int number)
    {
        const BaseSpecies *ofSpheres = nullptr, *ofWalls = nullptr;
        CASES
        for (int sign = 1; sign >= (atWall ? 1 : -1); sign -= 2) {
            for (size_t k = 0; k < incidence.size(); ++k) {
                const Vec3D velocity = Vec3D(friction * incidence[k], 0, -1) * speed
                    * (atWall ? 1.0 : sign / 2.0);
                SphericalParticle sphere;
                sphere.setSpecies(speciesHandler.getObject(ofSpheres->getIndex()));
                sphere.setRadius(radius);
                sphere.setVelocity(velocity);
                sphere.setPosition(
                    Vec3D(8 * k * radius, 0, sign * radius) - velocity * getTimeStep() * begins);
                spheres.push_back(particleHandler.copyAndAddObject(sphere));
            }
        }
        if (atWall) {
            InfiniteWall wall;
            wall.setSpecies(speciesHandler.getObject(ofWalls->getIndex()));
            wall.set(Vec3D(0, 0, -1), Vec3D(0, 0, 0));
            wallHandler.copyAndAddObject(wall);
        }
    }
};

int main()
{
    std::ofstream answers("answers");
    answers.precision(10);
    std::ifstream asked("asked");
    int number = 0, count;
    Impacts numbers;
    while (asked >> numbers.radius >> numbers.friction >> numbers.speed >> numbers.begins
           >> numbers.atWall >> count) {
        Impacts all;
        all.radius = numbers.radius;
        all.friction = numbers.friction;
        all.speed = numbers.speed;
        all.begins = numbers.begins;
        all.atWall = numbers.atWall;
        all.incidence.resize(count);
        for (double& x : all.incidence)
            asked >> x;
        all.setName("impacts");
        all.setFileType(FileType::NO_FILE);
        all.setMin(-4 * all.radius, -4 * all.radius, -4 * all.radius);
        all.setMax(8 * count * all.radius, 4 * all.radius, 4 * all.radius);
        all.lines(number++);
        all.setTimeMax(600 * all.getTimeStep());
        all.solve();
        if (all.interactionHandler.getNumberOfObjects())
            return 1; // still in contact
        for (int k = 0; k < count; ++k) {
            const SphericalParticle *one = all.spheres[k];
            double slip = one->getVelocity().X - all.radius * one->getAngularVelocity().Y;
            if (!all.atWall) {
                const SphericalParticle *other = all.spheres[count + k];
                slip -= other->getVelocity().X + all.radius * other->getAngularVelocity().Y;
            }
            answers << slip / (all.friction * all.speed) << (k + 1 < count ? " " : "\n");
        }
    }
}
